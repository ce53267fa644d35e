# Error of each model of a map against the contact fraction, from 0.1 to 99.9 %.
# arg: stiffness or contact, and the scene
kind = word(arg, 1); scene = word(arg, 2); file = tables."loads.csv"
eval sized(320)
here(i) = strcol("scene") eq scene && (i == 0 || strcol("label") eq nth(names, i))
stats file using (here(0) ? collect(strcol("label")) : 0) nooutput
logit(share) = log10(share / (1 - share)) # light and full loads have equal space
set xtics (""  logit(0.0001)); do for [p in "0.1 1 10 50 90 99 99.9"] { set xtics add (p logit(0.01 * p)) }
set logscale y; set format y "%g"; set xrange [logit(0.0005):logit(0.9995)]; set yrange [0.01:1000]
set xlabel "Contact fraction (%)"
set key outside right center vertical samplen 1 width -4 font ",12"
x(i) = here(i) && column("contact_fraction") < 1 ? logit(column("contact_fraction")) : NaN
y(i) = abs(column("error_".kind)) > 0 ? 100 * column("error_".kind) : NaN
plot for [i = 1:parts(names)] file using (x(i)):(y(0)) with linespoints lc i ps 0.4 title nth(names, i)
