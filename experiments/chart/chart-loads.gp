# Contact fraction or stiffness of theories, of one line of a map and of the exact solution against pressure.
what = word(arg, 1); scene = arg[strlen(what) + 2:*]
set logscale xy; set format "10^{%T}"
set xlabel "Mean pressure p over E*"; set ylabel (what eq "area" ? "Contact fraction A" : "Stiffness K (MPa/mm)")
file = tables."models.csv"; value = what eq "area" ? "contact_fraction" : "stiffness_MPa_per_mm"
error = what eq "area" ? "error_contact" : "error_stiffness"
here(i) = strcol("scene") eq scene
stats file using (here(0) ? collect(strcol("model")) : 0) nooutput
is_solved(name) = name eq "profile" || name eq "map" # they tend to the exact solution
short(name) = name eq "greenwood-williamson" ? "GW" : name eq "bush-gibson-thomas" ? "BGT" : name
shown(name) = here(0) && strcol("model") eq name && !is_solved(name) ? column("pressure_MPa") : NaN
plot file using (here(0) ? column("pressure_MPa") : NaN):(column(value) / (1 + column(error))) with points \
    lc rgb ink pt 7 ps 0.5 title "exact", \
    for [i = 1:parts(names)] file using (shown(nth(names, i))):(column(value)) with lines lc i \
    title (is_solved(nth(names, i)) ? "" : short(nth(names, i)))
