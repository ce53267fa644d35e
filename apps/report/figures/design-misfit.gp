# Misfit of the answer at each point of the target, in percent, on its grid and on a finer one.
# arg: number of the target, its quantity, pressure or displacement; in the units of its file: own and the labels of x
# and y; "finer" if it is known
here(i) = column("target") == int(word(arg, 1)); is_pressure = word(arg, 3) eq "pressure"
points = tables."points.csv"
stats points using (here(0) ? column("x") : NaN) nooutput
in_own_units = word(arg, 4) eq "own"
factor = in_own_units ? 1 : is_pressure ? pressure_factor(STATS_max) : length_factor(STATS_max)
set xlabel (in_own_units ? word(arg, 5) : is_pressure ? "Mean pressure p (".pressure_unit(STATS_max).")" : \
    "Displacement (".length_unit(STATS_max).")")
set ylabel "Misfit (%)"; set xrange [0:*]
if (STATS_min > 0 && STATS_max > 100 * STATS_min) { set logscale x; set xrange [0.8 * factor * STATS_min:*] } # decades
set arrow from graph 0, first 0 to graph 1, first 0 nohead lc rgb faint dt 2
p(i) = here(0) ? factor * column("x") : NaN
plot points using (p(0)):(100 * column("misfit")) with linespoints lc rgb blue lw 1.5 ps 0.45 title "answer", \
    points using (p(0)):(100 * column("misfit_finer")) \
        with linespoints lc rgb orange lw 1.5 ps 0.45 title (strstrt(arg, "finer") ? "finer grid" : "")
