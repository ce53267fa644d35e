# Stiffness or contact fraction of the answers against mean pressure; points are the target's stiffness.
# arg: quantity folder variants
quantity = word(arg, 1); folder = tables.word(arg, 2); K = quantity eq "stiffness"
stats folder."target.csv" using "pressure_MPa" nooutput
factor = pressure_factor(STATS_max); top = factor * STATS_max * 1.03
set xlabel sprintf("Mean pressure (%s)", pressure_unit(STATS_max)); set xrange [0:top]; set yrange [0:*]
set ylabel K ? "Stiffness K (MPa/mm)" : "Contact fraction A"
file = folder.(K ? "stiffness.csv" : "curves.csv")
plot for [k = 1:words(arg) - 2] file \
    using (strcol("variant") eq word(arg, k + 2) ? factor * column("pressure_MPa") : NaN): \
    (column(K ? "stiffness_MPa_per_mm" : "contact_fraction")) with lines lt k dt k title titled(word(arg, k + 2)), \
    folder."target.csv" using (K ? factor * column("pressure_MPa") : NaN):"stiffness_MPa_per_mm" \
    with points lc rgb ink pt 7 ps 0.5 title (K ? "target" : "")
