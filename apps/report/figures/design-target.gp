# A target, and the curves of the answer on its grid and on a finer one.
# arg: number of the target, its quantity, pressure or displacement; in the units of its file: own and the labels of x
# and y; further curves: finer, before, band
here(i) = column("target") == int(word(arg, 1)); quantity = word(arg, 2); is_pressure = word(arg, 3) eq "pressure"
has(name) = strstrt(arg, name) > 0
curves = tables."curves.csv"; points = tables."points.csv"
stats points using (here(0) ? column("x") : NaN) nooutput
in_own_units = word(arg, 4) eq "own"
factor = in_own_units ? 1 : is_pressure ? pressure_factor(STATS_max) : length_factor(STATS_max)
set xlabel (in_own_units ? word(arg, 5) : is_pressure ? "Mean pressure p (".pressure_unit(STATS_max).")" : \
    "Displacement (".length_unit(STATS_max).")")
set ylabel (in_own_units ? word(arg, 6) : quantity eq "stiffness" ? "Stiffness K (MPa/mm)" : \
    quantity eq "load" ? "Mean pressure p (MPa)" : quantity eq "contact_fraction" ? "Contact fraction A" : "Interface stiffness K_i (MPa/mm)") noenhanced
set xrange [0:*]; set yrange [0:*]; set key maxcols 3 width -1
if (STATS_min > 0 && STATS_max > 100 * STATS_min) { set logscale x; set xrange [0.8 * factor * STATS_min:*] } # decades
x(name) = here(0) && strcol("curve") eq name ? factor * column("x") : NaN
p(i) = here(0) ? factor * column("x") : NaN
plot curves using (x("answer")):"y" with lines lc rgb blue title "answer", \
    curves using (x("finer")):"y" with lines lc rgb orange dt 2 title (has("finer") ? "finer grid" : ""), \
    curves using (x("before")):"y" with lines lc rgb faint title (has("before") ? "before" : ""), \
    points using (p(0)):"lower" with lines lc rgb faint lw 1 title (has("band") ? "band" : ""), \
    points using (p(0)):"upper" with lines lc rgb faint lw 1 notitle, \
    points using (p(0)):"y" with points lc rgb ink pt 7 title "target"
