# The similarity that survives the given errors against that without errors, of genomes that no other one beats.
set xlabel "Similarity without errors"; set ylabel "Similarity that survives the errors"
plot tables."made.csv" using "similarity":"similarity_made" with linespoints lc rgb blue pt 7 title "front"
