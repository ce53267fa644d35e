# Share of random phase sets for which condition (10) and Eq. 8 hold against the number of ridges.
file = tables."ridges.csv"
set logscale x 2; set yrange [40:102]; set xlabel "Number of ridges M"; set ylabel "Share of phase sets (%)"
plot file using "ridges":(100 * column("as_printed")) with linespoints lc rgb blue title "(10) as printed", \
    file using "ridges":(100 * column("last_missing")) with linespoints lc rgb red title "(10), last pair missing", \
    file using "ridges":(100 * column("right_phase")) with linespoints lc rgb green title "(8): arccos gives θ"
