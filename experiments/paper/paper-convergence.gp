# Best similarity known after each stage against the contact curves and gradients spent.
# arg: folder variants
file = tables.word(arg, 1)."convergence.csv"; names = "sog gco cco sog-minimax gco-minimax cco-minimax"
eval sized(340)
set xlabel "Contact curves and gradients"; set ylabel "Best similarity"
plot for [d = 1:2] for [k = 1:3] file \
    using (strcol("variant") eq word(names, 3 * d - 3 + k) ? column("spent") : NaN):"best_similarity" \
    with linespoints lt k dt d title titled(word(names, 3 * d - 3 + k))
