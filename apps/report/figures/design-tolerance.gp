# Similarity that 95 % of the surfaces with height noise keep, against the rms of the noise.
noise = tables."tolerance.csv"
stats noise using "noise_rms_mm" nooutput
factor = length_factor(STATS_max)
set xlabel "Height noise, rms (".length_unit(STATS_max).")"; set ylabel "Similarity"
set logscale x; set xtics add autofreq; set yrange [*:1]
set arrow from graph 0, first real(arg) to graph 1, first real(arg) nohead lc rgb faint dt 2
plot noise using (factor * column("noise_rms_mm")):"quantile" with linespoints lc rgb blue title "95 % of draws", \
    noise using (factor * column("noise_rms_mm")):"median" with lines lc rgb orange dt 2 title "median"
