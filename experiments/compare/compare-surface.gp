# Heights of the best surface, or its contact pressure at the last load.
what = word(arg, 1); target = arg[strlen(what) + 2:*]
eval sized(400)
set size ratio -1; unset grid; unset key; set autoscale fix
file = tables."surfaces.csv"; c = what eq "heights" ? "height_mm" : "pressure_MPa"
here(i) = strcol("problem") eq target
stats file using (here(0) ? abs(column(c)) : NaN) nooutput
f = what eq "heights" ? length_factor(STATS_max) : pressure_factor(STATS_max)
set cblabel (what eq "heights" ? "Height (".length_unit(STATS_max).")" : "Pressure (".pressure_unit(STATS_max).")")
set xlabel "x (mm)"; set ylabel "y (mm)"
plot file using (here(0) ? column("x_mm") : NaN):(column("y_mm")):(f * column(c)) with image
