# Heights of a map below its highest point, or contact pressure at a load, as colours.
# arg: column of map.csv without its unit
file = tables."map.csv"; is_height = arg[1:6] eq "height"; shown = arg.(is_height ? "_mm" : "_MPa")
eval sized(400)
set size ratio -1; unset grid; unset key; set autoscale fix; set datafile missing "none"
stats file using "x_mm":shown nooutput
largest = STATS_max_y > -STATS_min_y ? STATS_max_y : -STATS_min_y
factor = is_height ? length_factor(largest) : pressure_factor(largest)
set cblabel (is_height ? "Height below the highest point (".length_unit(largest) : \
    "Pressure (".pressure_unit(largest)).")" offset 0.8,0; set cbtics offset -0.7,0
set xlabel "x (mm)"; set ylabel "y (mm)"
# A node out of contact has an empty field. As an undefined number it keeps its place in the image. (strcol() of an
# empty last field ends gnuplot 5.4.)
plot file using (column("x_mm")):(column("y_mm")):(column(shown) > -1e300 ? factor * column(shown) : NaN) with image
