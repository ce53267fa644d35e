# A law and the areas of the designed caps against the load.
# arg: name of the law
file = tables."curves.csv"
set xlabel "Load (N)"; set ylabel "Contact area (mm^2)"; set xrange [0:*]; set yrange [0:*]
here(i) = strcol("law") eq arg
stats file using (here(0) ? collect(strcol("curve")) : 0) nooutput
x(i) = here(0) && strcol("curve") eq nth(names, i) ? column("load_N") : NaN
plot for [i = 2:parts(names)] file using (x(i)):"area_mm2" with lines lc i - 1 title nth(names, i), \
    file using (x(1)):"area_mm2" with points lc rgb ink pt 7 ps 0.5 title "law"
