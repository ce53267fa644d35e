# Heights of the answers along the profile, each about its mean.
# arg: folder variants
file = tables.word(arg, 1)."heights.csv"
stats file using "height_mm" nooutput
factor = length_factor(STATS_max)
set autoscale xfix; set xlabel "x (mm)"; set ylabel sprintf("Height (%s)", length_unit(STATS_max))
plot for [k = 1:words(arg) - 1] file \
    using (strcol("variant") eq word(arg, k + 1) ? column("x_mm") : NaN):(factor * column("height_mm")) \
    with lines lt k lw 1.5 title titled(word(arg, k + 1))
