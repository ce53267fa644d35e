# Power spectral density against wavenumber.
# arg: unit of the density
set logscale xy; set format "10^{%T}"
set xlabel "Wavenumber q (rad/mm)"; set ylabel sprintf("Power spectral density C (%s)", arg)
stats tables."spectrum-drawn.csv" using "density" nooutput
set yrange [1e-12 * STATS_max:*] # less is rounding
plot tables."spectrum-drawn.csv" using "wave_number_rad_per_mm":"density" with lines lc rgb blue lw 1.2 notitle
