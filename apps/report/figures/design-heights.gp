# Heights below the highest point along the profile, of the answers or of the scan.
# arg: answers or scan
is_scan = arg eq "scan"; file = tables."heights-drawn.csv"
shown(i) = (strcol("surface") eq "scan") == is_scan
stats file using (shown(0) ? collect(strcol("surface")) : 0) nooutput
stats file using (shown(0) ? -column("height_mm") : NaN) nooutput
factor = length_factor(STATS_max)
set xlabel "x (mm)"; set ylabel sprintf("Height below the highest point (%s)", length_unit(STATS_max))
stats file using "x_mm" nooutput
set xrange [0:STATS_max]; set key maxcols 3 width -1
plot for [i = 1:parts(names)] file using (strcol("surface") eq nth(names, i) ? column("x_mm") : NaN): \
    (factor * column("height_mm")) with lines lc i lw (i == 1 ? 2 : 1.2) \
    title (is_scan ? "scan" : "answer ".nth(names, i))
