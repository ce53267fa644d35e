# 1 less the best similarity so far, in the median over the seeds, against what was spent.
axis = word(arg, 1); target = arg[strlen(axis) + 2:*]
eval sized(380)
set logscale xy; set format y "10^{%T}"
set xlabel (axis eq "seconds" ? "Time (s)" : "Curves and gradients"); set ylabel "1 - similarity"
file = tables."shortfall.csv"
here(i) = strcol("target") eq target && strcol("axis") eq axis
stats file using (here(0) ? collect(strcol("variant")) : 0) nooutput
plot for [i = 1:parts(names)] file \
    using (here(0) && strcol("variant") eq nth(names, i) ? column("spent") : NaN):(column("shortfall")) \
    with lines lc i title nth(names, i)
