# Share of readings and targets in which each claim holds, for each value of each choice of a reading.
file = tables."claims.csv"
eval sized(600)
stats file using "claim" nooutput
last = STATS_max + 1
stats file using (collect(strcol("value"))) nooutput
n = parts(names); place(i) = n - int(i) % n
before = ""; rules = ""
rule(choice, i) = (choice ne before ? (before = choice, rules = rules.sprintf(" %g", place(i) + 0.5), 1) : 0)
stats file every ::::n - 1 using (rule(strcol("choice"), $0)) nooutput
do for [y in rules] { set arrow from graph 0, first y to graph 1, first y nohead lc rgb faint lw 0.5 }
bin(share) = share <= 0 ? 1 : share < 0.5 ? 2 : share < 0.9 ? 3 : share < 1 ? 4 : 5
shades = red." ".orange." ".sky." ".blue." ".green
label(i) = word("'never' '< 50 %' '< 90 %' '< 100 %' 'always'", i)
set xlabel "Claim (numbers as in the table)"; set xrange [0:last]; set yrange [0:n + 1]; set ytics noenhanced
set key maxcols 2
plot file using (NaN):(place($0)):ytic(strcol("value")) with points notitle, \
    for [i = 1:5] file using (bin(column("share_holds")) == i ? column("claim") : NaN):(place($0)) with points \
    pt 7 ps 0.75 lc rgb word(shades, i) title label(i)
