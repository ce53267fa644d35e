# Height of the profile along its length, from its mean.
file = tables."heights-drawn.csv"
stats file using "x_mm" nooutput
across = STATS_max
stats file using (abs(column("height_mm"))) nooutput
up = STATS_max
set xlabel sprintf("Position x (%s)", length_unit(across)); set ylabel sprintf("Height z (%s)", length_unit(up))
set xrange [0:length_factor(across) * across]
plot file using (length_factor(across) * column("x_mm")):(length_factor(up) * column("height_mm")) with lines \
    lc rgb blue lw 1.2 notitle
