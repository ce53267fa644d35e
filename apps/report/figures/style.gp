# Style of all figures. Each colour has one meaning; the page replaces it by a colour of its theme.
# Another height: `eval sized(340)`.
sized(h) = sprintf("set terminal svg size 480,%d dynamic rounded enhanced font 'Arial,14' name '%s'", h, figure)
eval sized(300)
set encoding utf8; set minussign
set datafile separator comma; set datafile columnheaders; set datafile missing NaN
set border 3 lc rgb "#010203" lw 0.8; set tics nomirror out scale 0.4; set samples 2
set grid lc rgb "#808182" lw 0.3
set key noenhanced tmargin left horizontal Left reverse samplen 1.6 spacing 1.1 width 2
set xlabel offset 0,0.3
blue = "#0072b2"; orange = "#e69f00"; green = "#009e73"; purple = "#cc79a7"; sky = "#56b4e9"; red = "#d55e00"
ink = "#010203"; faint = "#808182"
set linetype 1 lc rgb blue lw 2 pt 7 ps 0.6;    set linetype 2 lc rgb orange lw 2 pt 5 ps 0.6
set linetype 3 lc rgb green lw 2 pt 9 ps 0.6;   set linetype 4 lc rgb purple lw 2 pt 13 ps 0.6
set linetype 5 lc rgb sky lw 2 pt 7 ps 0.6;     set linetype 6 lc rgb red lw 2 pt 5 ps 0.6
colours = blue." ".orange." ".green." ".purple." ".sky." ".red
do for [i = 7:18] { set linetype i lc rgb word(colours, (i - 1) % 6 + 1) lw 2 dt 2 + 2 * (i > 12) }
set linetype cycle 18
set palette defined (0 "#352a87", 0.25 "#0f5cdd", 0.5 "#06a4ca", 0.75 "#b1be59", 1 "#f9fb0e") maxcolors 64
# The unit in which a largest value m (MPa, mm) is a number below 1000, and its factor.
pressure_factor(m) = m < 1e-3 ? 1e6 : m < 1 ? 1e3 : m < 1e3 ? 1 : 1e-3
pressure_unit(m) = m < 1e-3 ? "Pa" : m < 1 ? "kPa" : m < 1e3 ? "MPa" : "GPa"
length_factor(m) = m < 1e-3 ? 1e6 : m < 1 ? 1e3 : m < 1e3 ? 1 : 1e-3
length_unit(m) = m < 1e-3 ? "nm" : m < 1 ? "µm" : m < 1e3 ? "mm" : "m"
# The title of a variant.
titled(name) = (at = strstrt("sog gco cco", name)) && strlen(name) == 3 ? substr("SOG GCO CCO", at, at + 2) : name
# The different words of a column, in their order: `names = ""; stats FILE using (collect(strcol("NAME"))) nooutput`,
# then nth(names, i) for i from 1 to parts(names).
names = ""
collect(s) = (strstrt("|".names, "|".s."|") == 0 ? (names = names.s."|", 1) : 0)
parts(s) = strstrt(s, "|") == 0 ? 0 : 1 + parts(s[strstrt(s, "|") + 1:*])
nth(s, i) = i == 1 ? s[1:strstrt(s, "|") - 1] : nth(s[strstrt(s, "|") + 1:*], i - 1)
# The names of n curves beside their ends, from the lowest end upwards and at least a gap apart: `eval names_at_ends`,
# with the curves' last values in the array `last`, and the axis from `bottom` to `top`.
names_at_ends = "array placed[n]; gap = 0.057 * (top - bottom); height = bottom - gap; unset key; \
set rmargin at screen 0.63; do for [i = 1:n] { placed[i] = 0 }; do for [k = 1:n] { lowest = 0; \
do for [i = 1:n] { if (!placed[i] && (lowest == 0 || last[i] < last[lowest])) { lowest = i } }; \
placed[lowest] = 1; height = last[lowest] > height + gap ? last[lowest] : height + gap; \
height = height > top - gap * (n - k) ? top - gap * (n - k) : height; \
set arrow k from graph 1, first last[lowest] to graph 1.06, first height nohead lt lowest; \
set label k nth(names, lowest) at graph 1.08, first height noenhanced font ',12' }"
