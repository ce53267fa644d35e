# 1 less the best similarity so far against the price: median over the seeds, with its interval.
eval sized(380)
set logscale x; set format y "10^{%.0f}"; set ytics 1
set xlabel "Price (curves on the search grid)"; set ylabel "1 - similarity"
file = tables."progress.csv"
stats file using (strcol("problem") eq arg ? collect(strcol("variant")) : 0) nooutput
at(i) = strcol("problem") eq arg && strcol("variant") eq nth(names, i) ? column("evaluations") : NaN
shown(c) = log10(column(c) > 1e-5 ? column(c) : 1e-5)
stats file using (strcol("problem") eq arg ? column("evaluations") : NaN) nooutput
set xrange [10 ** floor(log10(STATS_min)):STATS_max]
stats file using (strcol("problem") eq arg ? shown("precision") : NaN) nooutput
n = parts(names); array last[n]; bottom = floor(STATS_min - 1e-9); top = ceil(STATS_max)
do for [i = 1:n] { stats file using (at(i) > 0 ? shown("precision") : NaN) nooutput; last[i] = STATS_min }
set yrange [bottom:top]; eval names_at_ends
plot for [i = 1:n] file using (at(i)):(shown("precision")) with lines lt i notitle, \
    for [i = 1:n] file using (at(i)):(shown("lower")) with lines lc i lw 0.7 dt 3 notitle, \
    for [i = 1:n] file using (at(i)):(shown("upper")) with lines lc i lw 0.7 dt 3 notitle
