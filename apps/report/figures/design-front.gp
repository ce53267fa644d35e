# Similarity to the second target against similarity to the first, for genomes that no other dominates.
set xlabel "Similarity to the first target"; set ylabel "Similarity to the second target"
file = tables."front.csv"
plot file using "similarity_1":"similarity_2" with linespoints lc rgb blue title "front", \
    file using "refined_1":"refined_2" with points lc rgb orange pt 5 title "finer grid"
