# Error against time of each model of a scene, with names. A line joins the best trade-offs.
# arg: stiffness or contact, "small" for a picture without names or "named", and the scene
kind = word(arg, 1); is_small = word(arg, 2) eq "small"; scene = word(arg, 3)
eval sized(is_small ? 300 : 480)
here(name) = strcol("scene") eq scene && strcol("kind") eq kind && (name eq "" || strcol("family") eq name)
axes = tables."axes.csv"; file = tables."points.csv"
x_from = 1e99; x_to = 1e-99; y_from = 1e99; y_to = 1e-99; floor = 0 # of the scene, or of all scenes if small
take(i) = (x_from = column(3) < x_from ? column(3) : x_from, x_to = column(4) > x_to ? column(4) : x_to, \
    y_from = column(5) < y_from ? column(5) : y_from, y_to = column(6) > y_to ? column(6) : y_to, \
    floor = here("") ? column(7) : floor, 1)
stats axes using (is_small || here("") ? take(0) : 0) nooutput
# The plot of names has 410 x 424 pixels, for which their places were found.
unset key
if (!is_small) { set lmargin at screen 62.0 / 480; set rmargin at screen 472.0 / 480
    set bmargin at screen 34.0 / 480; set tmargin at screen 458.0 / 480 }
set logscale xy; set xrange [x_from:x_to]; set yrange [100 * y_from:100 * y_to]
set format y "%g"; set xtics (""  1e-9)
do for [k = 0:8] { set xtics add (word("1 10 100", k % 3 + 1)." ".word("µs ms s", k / 3 + 1) 10.0**(k - 6)) }
families = "theory profile map"; shade(f) = f eq "theory" ? orange : f eq "profile" ? green : blue
x(f) = here(f) ? column("seconds") : NaN
far(name) = here("") && column("label_is_far") == 1 ? column(name) : NaN
at(side) = here("") && column("label_left") == side ? column("label_seconds") : NaN
if (floor > 0) { set object 1 rectangle from graph 0, graph 0 to graph 1, first 100 * floor fc rgb faint \
    fs solid 0.2 noborder behind
    if (!is_small) { set label 1 "not claimed: the reference's own error" at graph 0.02, first 100 * floor \
    offset 0,-0.6 tc rgb ink font ",13" } }
plot file using (here("") && column("best") == 1 ? column("seconds") : NaN):(100 * column("error")) \
    with lines lc rgb faint lw 1.5 notitle, \
    file using (is_small ? NaN : far("seconds")):(100 * column("error")): \
    (column("label_seconds") - column("seconds")):(100 * (column("label_error") - column("error"))) \
    with vectors nohead lc rgb faint lw 0.7 notitle, \
    for [f in families] file using (x(f)):(100 * column("error")) with points lc rgb shade(f) \
    pt 7 ps (is_small ? 0.5 : 0.7) notitle, \
    file using (column("answered") < 9 ? here("") ? column("seconds") : NaN : NaN):(100 * column("error")) \
    with points lc rgb ink pt 6 ps (is_small ? 0.7 : 1) notitle, \
    file using (is_small ? NaN : at(1)):(100 * column("label_error")):(strcol("label")) with labels left noenhanced \
    font ",13" tc rgb ink notitle, \
    file using (is_small ? NaN : at(-1)):(100 * column("label_error")):(strcol("label")) with labels right noenhanced \
    font ",13" tc rgb ink notitle
