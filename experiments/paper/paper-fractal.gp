# A self-affine profile and its dominant bands: heights, stiffness or contact fraction.
# arg: heights, stiffness or area
heights = tables."fractal-heights.csv"; curves = tables."fractal-curves.csv"
eval sized(340)
if (arg eq "heights") {
    set xlabel "x (mm)"; set ylabel "Height (µm)"
    plot heights using "x_mm":(1e3 * column("whole_mm")) with lines lc rgb faint lw 1.2 title "whole", \
        heights using "x_mm":(1e3 * column("reduced_mm")) with lines lc rgb red title "dominant bands"
} else {
    stats curves using "pressure_MPa" nooutput
    is_shown(name) = strcol("profile") eq name && strcol("quantity") eq arg
    p(name) = is_shown(name) ? pressure_factor(STATS_max) * column("pressure_MPa") : NaN
    set xlabel sprintf("Mean pressure (%s)", pressure_unit(STATS_max)); set xrange [0:*]; set yrange [0:*]
    set ylabel arg eq "area" ? "Contact fraction A" : "Stiffness K (MPa/mm)"
    plot curves using (p("whole")):"value" with points lc rgb ink pt 7 ps 0.6 title "whole", \
        curves using (p("reduced")):"value" with lines lc rgb red title "dominant bands"
}
