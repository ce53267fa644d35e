# Share of targets that each variant has reached against evaluations per gene, with intervals.
eval sized(380)
set logscale x; set autoscale xfix; set yrange [0:1]
set xlabel (arg[1:9] eq "roughness" ? "Price (curves on the search grid)" : "Evaluations per gene")
set ylabel "Share of targets reached"
file = tables."ecdf.csv"
stats file using (strcol("group") eq arg ? collect(strcol("variant")) : 0) nooutput
at(i) = strcol("group") eq arg && strcol("variant") eq nth(names, i) ? column("evaluations_per_gene") : NaN
n = parts(names); array last[n]; bottom = 0; top = 1
do for [i = 1:n] { stats file using (at(i) > 0 ? column("share") : NaN) nooutput; last[i] = STATS_max }
eval names_at_ends
plot for [i = 1:n] file using (at(i)):(column("share")) with lines lt i notitle, \
    for [i = 1:n] file using (at(i)):(column("lower")) with lines lc i lw 0.7 dt 3 notitle, \
    for [i = 1:n] file using (at(i)):(column("upper")) with lines lc i lw 0.7 dt 3 notitle
