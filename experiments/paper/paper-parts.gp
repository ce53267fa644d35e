# Two curves of the database and the target: one is best at low pressures, the other at high ones.
# arg: folder genomes
folder = tables.word(arg, 1); file = tables."database.csv"
stats folder."target.csv" using "pressure_MPa" nooutput
factor = pressure_factor(STATS_max); set xlabel sprintf("Mean pressure (%s)", pressure_unit(STATS_max))
set ylabel "Stiffness K (MPa/mm)"; set xrange [0:*]; set yrange [0:*]
plot for [k = 1:words(arg) - 1] file using (column("id") == word(arg, k + 1) ? factor * column("pressure_MPa") : NaN): \
    "stiffness_MPa_per_mm" with lines lt k dt k title "genome ".word(arg, k + 1), \
    folder."target.csv" using (factor * column("pressure_MPa")):"stiffness_MPa_per_mm" \
    with points lc rgb ink pt 7 ps 0.5 title "target"
