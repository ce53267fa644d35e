# Similarity with the given errors against similarity without, for genomes that no other dominates.
set xlabel "Similarity without errors"; set ylabel "Similarity with the given errors"
plot tables."made.csv" using "similarity":"similarity_made" with linespoints lc rgb blue pt 7 title "front"
