# Error of each solver's runs against time per curve; lines join the best of a solver, rings mark the best of all.
kind = word(arg, 1); scene = arg[strlen(kind) + 2:*]
set logscale xy; set format "10^{%T}"
set xlabel "Time per curve (s)"; set ylabel "Error of the ".(kind eq "contact" ? "contact fraction" : kind)
file = tables."points.csv"
is_solver(name) = strcol("scene") eq scene && name ne "auto"
stats tables."chart.csv" using (is_solver(strcol("method")) ? collect(strcol("method")) : 0) nooutput
here(i) = strcol("scene") eq scene && strcol("kind") eq kind && (i == 0 || strcol("method") eq nth(names, i))
plot for [i = 1:parts(names)] file using (here(i) ? column("seconds") : NaN):(column("error")) \
    with points lc i pt 7 ps 0.4 notitle, \
    for [i = 1:parts(names)] file using (here(i) && column("best") > 0 ? column("seconds") : 1/0):(column("error")) \
    with points lc i pt 7 ps 0.8 title nth(names, i), \
    file using (here(0) && column("best") == 2 ? column("seconds") : NaN):(column("error")) \
    with points lc rgb ink pt 6 ps 1.2 title "best of all"
