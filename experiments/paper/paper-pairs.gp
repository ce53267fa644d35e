# Pairs of Hurst exponent and frequency ratio, spread evenly over their rectangle.
set xlabel "Hurst exponent H"; set ylabel "Frequency ratio γ"
plot tables."genomes.csv" using (column("phase_column") == 1 ? column("H") : NaN):"gamma" with points lt 1 ps 1 notitle
