# Tangent stiffness or contact fraction against mean pressure.
# arg: stiffness or contact, and the end of the curve's file name after the prefix of the tables
what = word(arg, 1); is_stiffness = what eq "stiffness"
file = tables[1:strlen(tables) - 1].arg[strlen(what) + 2:*]
stats file using "pressure_MPa" nooutput
factor = pressure_factor(STATS_max)
set xlabel sprintf("Mean pressure p (%s)", pressure_unit(STATS_max)); set xrange [0:*]; set yrange [0:*]
if (STATS_min > 0 && STATS_max > 1000 * STATS_min) { set logscale xy; set xrange [*:*]; set yrange [*:*] } # decades
set ylabel is_stiffness ? "Stiffness K (MPa/mm)" : "Contact fraction A"
# The band of a scan or map is in columns 7 to 10, which the file of a genome lacks.
plot file using (factor * column(2)):(column(is_stiffness ? 9 : 7)):(column(is_stiffness ? 10 : 8)) \
    with filledcurves lc rgb blue fs transparent solid 0.25 notitle, \
    file using (factor * column("pressure_MPa")): \
    (column(is_stiffness ? "tangent_stiffness_MPa_per_mm" : "contact_fraction")) with linespoints lc rgb blue lw 1.5 \
    ps 0.4 notitle
