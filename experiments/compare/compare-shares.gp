# Share of targets that each variant has reached against evaluations per gene, with intervals.
eval sized(380)
set logscale x; set autoscale xfix; set yrange [0:1]
set xlabel (arg[1:9] eq "roughness" ? "Curves and gradients" : "Evaluations per gene")
set ylabel "Share of targets reached"
file = tables."ecdf.csv"
stats file using (strcol("group") eq arg ? collect(strcol("variant")) : 0) nooutput
at(i) = strcol("group") eq arg && strcol("variant") eq nth(names, i) ? column("evaluations_per_gene") : NaN
# Names stand at the ends of their curves, from the lowest end upwards and at least a gap apart.
n = parts(names); array last[n]; array placed[n]; gap = 0.057; height = -1; unset key; set rmargin at screen 0.63
do for [i = 1:n] { stats file using (at(i) > 0 ? column("share") : NaN) nooutput; last[i] = STATS_max; placed[i] = 0 }
do for [k = 1:n] { lowest = 0; highest = 1 - gap * (n - k)
    do for [i = 1:n] { if (!placed[i] && (lowest == 0 || last[i] < last[lowest])) { lowest = i } }
    placed[lowest] = 1; height = last[lowest] > height + gap ? last[lowest] : height + gap
    height = height > highest ? highest : height
    set arrow k from graph 1, first last[lowest] to graph 1.06, first height nohead lt lowest
    set label k nth(names, lowest) at graph 1.08, first height noenhanced font ",12" }
plot for [i = 1:n] file using (at(i)):(column("share")) with lines lt i notitle, \
    for [i = 1:n] file using (at(i)):(column("lower")) with lines lc i lw 0.7 dt 3 notitle, \
    for [i = 1:n] file using (at(i)):(column("upper")) with lines lc i lw 0.7 dt 3 notitle
