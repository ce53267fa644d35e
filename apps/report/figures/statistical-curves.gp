# The target, the theory's curve and the exact curves of surfaces against pressure.
file = tables."curves.csv"
set logscale xy; set format "10^{%T}"
set xlabel "Mean pressure p (MPa)"; set ylabel arg
stats file using (collect(strcol("curve"))) nooutput
p(i) = strcol("curve") eq nth(names, i) ? column("pressure_MPa") : NaN
plot file using (p(1)):3 with points lc rgb ink pt 7 title nth(names, 1), \
    file using (p(2)):3 with lines lc rgb orange title nth(names, 2), \
    for [i = 3:parts(names)] file using (p(i)):3 with lines lc rgb blue lw 1.2 title nth(names, i)
