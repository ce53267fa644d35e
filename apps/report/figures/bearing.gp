# Material ratio curve: height, from the mean, against the share of the nodes that are higher.
file = tables."bearing.csv"
stats file using "height_mm" nooutput
mean = STATS_mean; up = STATS_max - mean > mean - STATS_min ? STATS_max - mean : mean - STATS_min
set xlabel "Material ratio (%)"; set xrange [0:100]; set ylabel sprintf("Height z (%s)", length_unit(up))
plot file using (100 * column("material_ratio")):(length_factor(up) * (column("height_mm") - mean)) with lines \
    lc rgb blue notitle
