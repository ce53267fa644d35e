# Best similarity, number of children or share of children above 0.95 of GCO and CCO against the threshold.
# arg: quantity folder
what = word(arg, 1); file = tables.word(arg, 2)."thresholds.csv"; names = "gco cco"
eval sized(340)
stats tables.word(arg, 2)."target.csv" using "pressure_MPa" nooutput
factor = pressure_factor(STATS_max)
set xlabel sprintf("Threshold (%s)", pressure_unit(STATS_max)); if (what ne "best") { set yrange [0:*] }
set ylabel what eq "best" ? "Best similarity" : what eq "size" ? "|U₃|" : "Share above 0.95"
p(i) = strcol("variant") eq word(names, i) ? factor * column("p_bar_MPa") : NaN
y(k) = what eq "size" ? column("U1") * column("U2") : what eq "share" ? column("share_above") : \
    column(k == 1 ? "similarity" : "best_child")
plot for [i = 1:2] file using (p(i)):(y(1)) with linespoints lt i + 1 title titled(word(names, i)), \
    for [i = 1:2] file using (what eq "best" ? p(i) : NaN):(y(2)) with lines lt i + 1 lw 1 dt 3 notitle
