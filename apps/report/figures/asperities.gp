# Heights of an array of caps as colours, and the contact spots at the verified loads, each spot to scale.
caps = tables."asperities.csv"; spots = tables."spots.csv"
eval sized(400)
set size ratio -1; unset grid; set key outside bottom center horizontal height 1
stats caps using "height_mm" nooutput
factor = length_factor(STATS_max); lowest = factor * STATS_min
set cblabel "Height (".length_unit(STATS_max).")" offset 0.5,0; set xlabel "x (mm)"; set ylabel "y (mm)"
loads = ""
stats spots using (names = loads, collect(strcol("load_N")), loads = names, 0) nooutput
reach(k) = strcol("load_N") eq nth(loads, k) && column("spot_radius_mm") > 0 ? column("spot_radius_mm") : NaN
plot caps using "x_mm":"y_mm":(column("radius_mm")):(factor * column("height_mm")) \
        with circles fill solid 0.8 noborder lc palette notitle, \
    for [k = 1:parts(loads)] spots using (column("x_mm")):(column("y_mm")):(reach(k)) \
        with circles fill empty lw 1.2 lc rgb (k == 1 ? ink : k == 2 ? red : faint) \
        title sprintf("spots at %.3g N", nth(loads, k) + 0)
