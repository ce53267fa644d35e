# Similarity of the three best candidates of SOG, GCO and CCO before and after each refinement.
# arg: folder
file = tables.word(arg, 1)."refinements.csv"; names = "sog gco cco"
set xrange [-0.5:10.5]; set yrange [*:1]; set ylabel "Similarity"
set xtics ("(0)" 0, "(1)" 1, "(2)" 2, "(0)" 4, "(1)" 5, "(2)" 6, "(0)" 8, "(1)" 9, "(2)" 10)
do for [i = 1:3] { set label i titled(word(names, i)) at 4 * i - 3, graph 1.03 center }
set key off
plot for [i = 1:3] for [rank = 1:3] file \
    using (strcol("variant") eq word(names, i) && column("rank") == rank ? 4 * i - 4 + column("stage") : NaN): \
    "similarity" with linespoints lt rank
