# Processor time or saving of a curve against the requested accuracy, medians over random surfaces.
file = tables."medians.csv"; kernel = word(arg, 1); what = word(arg, 2)
eval sized(340)
set logscale xy; set format "10^{%T}"
set xlabel "Requested accuracy"
set ylabel (what eq "saving" ? "Resolved time over time" : "Time (ms)")
load(dash) = word("full light", dash)
row(surface, load) = strcol("kernel") eq kernel && strcol("surface") eq surface && strcol("load") eq load
plot for [s in "smooth rough"] for [dash = 1:2] file \
    using (row(s, load(dash)) ? column("accuracy") : NaN):(column(what)) with linespoints \
    lc rgb (s eq "smooth" ? blue : orange) dt dash title sprintf("%s, %s load", s, load(dash))
