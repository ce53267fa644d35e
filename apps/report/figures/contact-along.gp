# Contact pressure, or the gap between the profile and the deformed body, along the profile at several mean pressures.
# arg: pressure or gap
is_pressure = arg eq "pressure"; file = tables."along.csv"; shown = is_pressure ? "pressure_MPa" : "gap_mm"
loads = ""
# (gnuplot 5.4 takes no "1e-05" for a number.)
add(p) = (loads = loads.sprintf(" %.9e", p), p)
stats tables."loads.csv" using (add(column("mean_pressure_MPa"))) nooutput
mean = STATS_max
stats file using "x_mm" nooutput
across = STATS_max
stats file using shown nooutput
factor = is_pressure ? pressure_factor(STATS_max) : length_factor(STATS_max)
set xlabel sprintf("Position x (%s)", length_unit(across))
set ylabel (is_pressure ? "Pressure (".pressure_unit(STATS_max) : "Gap (".length_unit(STATS_max)).")"
set xrange [0:length_factor(across) * across]; set yrange [0:*]
plot for [i = words(loads):1:-1] file using (column("load") == i ? length_factor(across) * column("x_mm") : NaN): \
    (factor * column(shown)) with lines lc i lw 1.2 \
    title sprintf("%.3g %s", pressure_factor(mean) * word(loads, i), pressure_unit(mean))
