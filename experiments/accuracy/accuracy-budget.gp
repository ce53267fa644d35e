# Sizes of all sources of error of a designed surface.
set logscale y; set format y "10^{%T}"; set xtics 1; unset key
set xlabel "Row of the table"; set ylabel "Relative size"
plot tables."budget.csv" using ($0 + 1):(column("size") > 1e-16 ? column("size") : 1e-16) with points lc rgb blue pt 7
