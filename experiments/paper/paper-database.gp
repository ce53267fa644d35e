# Stiffness curves of the database's genomes, rising with pressure, and the targets among them.
# arg: folder and title of each target
file = tables."database.csv"
stats file using "id" nooutput
last = int(STATS_max)
stats tables."target.csv" using "pressure_MPa" nooutput
factor = pressure_factor(STATS_max); set xlabel sprintf("Mean pressure (%s)", pressure_unit(STATS_max))
set ylabel "Stiffness K (MPa/mm)"; set xrange [0:*]; set yrange [0:*]
plot for [i = 0:last] file using (column("id") == i ? factor * column("pressure_MPa") : NaN):"stiffness_MPa_per_mm" \
    with lines lc rgb faint lw 0.6 title (i ? "" : "the database"), \
    for [t = 1:words(arg) / 2] tables.word(arg, 2 * t - 1)."target.csv" \
    using (factor * column("pressure_MPa")):"stiffness_MPa_per_mm" with linespoints lt (t == 1 ? 1 : 6) \
    title word(arg, 2 * t)." target"
