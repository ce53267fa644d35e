# A target and the curves of the answer, or the misfit of the answer at each point in percent.
# arg: target or misfit; number of the target, its quantity, pressure or displacement; in the units of its file: own and
# the labels of x and y; further curves: finer, verified, before, band
is_misfit = word(arg, 1) eq "misfit"; number = int(word(arg, 2)); quantity = word(arg, 3)
is_pressure = word(arg, 4) eq "pressure"; in_own_units = word(arg, 5) eq "own"
here(i) = column("target") == number
shown(curve, name) = strstrt(arg, curve) ? name : ""
curves = tables."curves.csv"; points = tables."points.csv"
stats points using (here(0) ? column("x") : NaN) nooutput
factor = in_own_units ? 1 : is_pressure ? pressure_factor(STATS_max) : length_factor(STATS_max)
set xlabel (in_own_units ? word(arg, 6) : is_pressure ? "Mean pressure p (".pressure_unit(STATS_max).")" : \
    "Displacement (".length_unit(STATS_max).")")
set xrange [0:*]
if (STATS_min > 0 && STATS_max > 100 * STATS_min) { set logscale x; set xrange [0.8 * factor * STATS_min:*] } # decades
p(i) = here(0) ? factor * column("x") : NaN
if (is_misfit) {
    set ylabel "Misfit (%)"
    set arrow from graph 0, first 0 to graph 1, first 0 nohead lc rgb faint dt 2
    plot points using (p(0)):(100 * column("misfit")) with linespoints lc rgb blue lw 1.5 ps 0.45 title "answer", \
        points using (p(0)):(100 * column("misfit_verified")) with linespoints lc rgb orange lw 1.5 ps 0.45 \
            title shown("verified", "as verified")
} else {
    set ylabel (in_own_units ? word(arg, 7) : quantity eq "stiffness" ? "Stiffness K (MPa/mm)" : \
        quantity eq "load" ? "Mean pressure p (MPa)" : quantity eq "contact_fraction" ? "Contact fraction A" : \
        "Interface stiffness K_i (MPa/mm)") noenhanced
    set yrange [0:*]; set key maxcols 3 width -1
    x(name) = strcol("curve") eq name ? p(0) : NaN
    plot curves using (x("answer")):"y" with lines lc rgb blue title "answer", \
        curves using (x("finer")):"y" with lines lc rgb orange dt 2 title shown("finer", "finer grid"), \
        curves using (x("before")):"y" with lines lc rgb faint title shown("before", "before"), \
        points using (p(0)):"lower" with lines lc rgb faint lw 1 title shown("band", "band"), \
        points using (p(0)):"upper" with lines lc rgb faint lw 1 notitle, \
        points using (p(0)):"y" with points lc rgb ink pt 7 title "target"
}
