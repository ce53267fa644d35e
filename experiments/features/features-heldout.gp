# Share of new starts that stay below a similarity, by the phases that may move.
set xlabel "Similarity"; set ylabel "Share of starts with a lower one"; set yrange [0:1]; set xrange [0.8:1]
phases(i) = word("all needed other", i)." phases"
file = tables."heldout.csv"
similarity(i) = strcol("phases") eq phases(i) ? column("similarity") : NaN
array n[3]
do for [i = 1:3] { stats file using (similarity(i)) nooutput; n[i] = STATS_records }
plot for [i = 1:3] file using (similarity(i)):(1.0 / n[i]) smooth cumulative with steps lc i title phases(i)
