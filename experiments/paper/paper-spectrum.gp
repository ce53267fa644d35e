# Continuous spectrum of an answer and, as points, the height of each of its genome's waves in it.
# arg: variant folder
folder = tables.word(arg, 2); is_shown(name) = name eq word(arg, 1)
eval sized(340)
set logscale xy; set format "10^{%T}"; set xlabel "Wavenumber (rad/mm)"; set ylabel "Density (mm³)"
set yrange [1e-22:*]
plot folder."spectra.csv" using (is_shown(strcol("variant")) ? column("wavenumber_rad_per_mm") : NaN):"density_mm3" \
    with lines lc rgb blue title "continuous", \
    folder."lines.csv" using (is_shown(strcol("variant")) ? column("wavenumber_rad_per_mm") : NaN):"density_mm3" \
    with points lc rgb red pt 7 ps 0.5 title "discrete"
