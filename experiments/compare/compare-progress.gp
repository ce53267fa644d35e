# 1 less the best similarity so far against the price: median over the seeds, with its interval.
eval sized(380)
set logscale xy; set format y "10^{%T}"
set xlabel "Price (curves on the search grid)"; set ylabel "1 - similarity"
file = tables."progress.csv"
stats file using (strcol("problem") eq arg ? collect(strcol("variant")) : 0) nooutput
at(i) = strcol("problem") eq arg && strcol("variant") eq nth(names, i) ? column("evaluations") : NaN
shown(c) = column(c) > 1e-5 ? column(c) : 1e-5
plot for [i = 1:parts(names)] file using (at(i)):(shown("precision")) with lines lc i title nth(names, i), \
    for [i = 1:parts(names)] file using (at(i)):(shown("lower")) with lines lc i lw 0.7 dt 3 notitle, \
    for [i = 1:parts(names)] file using (at(i)):(shown("upper")) with lines lc i lw 0.7 dt 3 notitle
