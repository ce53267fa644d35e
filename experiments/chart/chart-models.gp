# Error of theories, one line and solved grids against time per curve of twelve loads.
what = word(arg, 1); scene = arg[strlen(what) + 2:*]
set logscale xy; set format "10^{%T}"
set xlabel "Time per curve (s)"; set ylabel "Error of the ".(what eq "area" ? "contact fraction" : "stiffness")
file = tables."model_errors.csv"
family(i) = i == 1 ? "theories" : i == 2 ? "one line" : "solved"
here(i) = strcol("scene") eq scene && strcol("family") eq family(i)
plot for [i = 1:3] file using (here(i) ? column("seconds") : NaN):(column(what)) with points \
    lc rgb (i == 1 ? orange : i == 2 ? green : blue) pt 7 ps 0.8 title family(i)
