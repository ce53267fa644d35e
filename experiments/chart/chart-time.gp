# Time per curve of 20 load steps at tolerance 1e-6 against the number of nodes, for each solver.
set logscale xy; set format y "10^{%T}"
set xlabel "Nodes N"; set ylabel "Time per curve (s)"
file = tables."chart.csv"
is_solver(name) = strcol("scene") eq arg && name ne "auto"
stats file using (is_solver(strcol("method")) ? collect(strcol("method")) : 0) nooutput
here(i) = strcol("scene") eq arg && strcol("method") eq nth(names, i) && column("steps") == 20 && \
    strcol("outcome") eq "solved" && (column("tolerance") == 0 || abs(column("tolerance") / 1e-6 - 1) < 0.01)
plot for [i = 1:parts(names)] file using (here(i) ? column("nodes") : NaN):(column("seconds")) with linespoints lc i \
    title nth(names, i)
