# Eight cosines of one wavelength and their sum, which is a cosine of the same length.
# arg: n
file = tables."chromosomes.csv"; is_shown(m) = column("n") == arg + 0 && column("ridge") == m
set xlabel "x (µm)"; set ylabel "Height (µm)"
plot for [m = 1:8] file using (is_shown(m) ? 1e3 * column("x_mm") : NaN):(1e3 * column("height_mm")) \
    with lines lc rgb faint lw 1 title (m == 1 ? "its 8 ridges" : ""), \
    file using (is_shown(0) ? 1e3 * column("x_mm") : NaN):(1e3 * column("height_mm")) \
    with lines lc rgb blue lw 2.5 title "chromosome"
