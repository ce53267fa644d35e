# Share of targets that each variant has reached against evaluations per gene, with intervals.
eval sized(380)
set logscale x; set yrange [0:1]
set xlabel (arg[1:9] eq "roughness" ? "Curves and gradients" : "Evaluations per gene"); set ylabel "Share of targets reached"
file = tables."ecdf.csv"
stats file using (strcol("group") eq arg ? collect(strcol("variant")) : 0) nooutput
at(i) = strcol("group") eq arg && strcol("variant") eq nth(names, i) ? column("evaluations_per_gene") : NaN
plot for [i = 1:parts(names)] file using (at(i)):(column("share")) with lines lc i title nth(names, i), \
    for [i = 1:parts(names)] file using (at(i)):(column("lower")) with lines lc i lw 0.7 dt 3 notitle, \
    for [i = 1:parts(names)] file using (at(i)):(column("upper")) with lines lc i lw 0.7 dt 3 notitle
