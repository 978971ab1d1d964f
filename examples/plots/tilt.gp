# Punches under an eccentric force: contact length over the eccentricity, pressure, and errors.
# Run in the folder of tilt_length.csv, tilt_pressure.csv and tilt_error.csv.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("tilt", 800, 700)
set datafile separator ","
set multiplot

eval panel(0.085, 0.48, 0.58, 0.95)
set title "Contact length: fuge on the exact curves" offset 0, -0.3
set xlabel "eccentricity e / a" offset 0, 0.3
set ylabel "length / 2a" offset 1
set xrange [0:1]
set yrange [0:1.1]
set key bottom left
eval gridlines
plot "tilt_length.csv" using (strcol(1) eq "flat" ? $2 : NaN):4 with lines ls KNOWN title "exact", \
     "" using (strcol(1) eq "rounded" ? $2 : NaN):4 with lines ls KNOWN notitle, \
     "" using (strcol(1) eq "flat" ? $2 : NaN):3 with points ls FUGE ps 0.6 title "flat punch", \
     "" using (strcol(1) eq "rounded" ? $2 : NaN):3 with points ls FUGE_TOO ps 0.6 title "rounded punch"

set title "Errors fall with the number of cells"
eval panel(0.58, 0.97, 0.58, 0.95)
set xlabel "cells"
set ylabel "relative error" offset 0
set logscale xy
set xrange [32:524288]
set yrange [1e-11:1e2]
set xtics ("2^6" 64, "2^{10}" 1024, "2^{14}" 16384, "2^{18}" 262144)
set mxtics 1
set mytics 1
set ytics ("10^{-9}" 1e-9, "10^{-6}" 1e-6, "10^{-3}" 1e-3, "1" 1)
set key top right noreverse Right
eval gridlines
at(name, e, column) = strcol(1) eq name && abs($2 - e) < 0.01 ? column : NaN
plot "tilt_error.csv" using 3:(at("flat", 0.72, $4)) with linespoints ls FUGE title "flat, e = 0.72a: rotation", \
     "" using 3:(at("flat", 0.72, $6)) with linespoints ls FUGE pt 6 title "pressure in the middle", \
     "" using 3:(at("rounded", 0.25, $5)) with linespoints ls FUGE_TOO title "rounded, e = 0.25a: approach", \
     "" using 3:(at("rounded", 0.25, $6)) with linespoints ls FUGE_TOO pt 8 title "pressure in the middle"
unset logscale
set format y "%g"

# Full contact up to e = a/2, beyond it a contact of half length b = 2 (a - e) at the corner.
a = 10.0
F = 5000.0
full(x, e) = F*(1 + 2*e*x/a**2)/(pi*sqrt(a**2 - x**2))
b(e) = 2*(a - e)
lifted(x, e) = x > a - 2*b(e) ? F/(pi*b(e))*sqrt((x - a + 2*b(e))/(a - x)) : 0
p(x, e) = abs(x) >= a ? NaN : (e > a/2 ? lifted(x, e) : full(x, e))
set title "Flat punch, a = 10 mm, F = 5 kN/mm: pressure leaves the side away from the force"
eval panel(0.085, 0.97, 0.075, 0.445)
set xlabel "x [mm]"
set ylabel "pressure [N/mm^2]" offset 0.3
set xrange [-10:10]
set xtics 5
set ytics autofreq 200
set yrange [0:900]
set samples 1001
set key at graph 0.4, 0.98 center top reverse Left
eval gridlines
plot p(x, 0) with lines ls KNOWN title "exact", \
     for [k=1:3] p(x, 0.25*k*a) with lines ls KNOWN notitle, \
     for [k=0:3] "tilt_pressure.csv" using 1:k+2 with points pt int(word("7 9 13 5", k + 1)) ps 0.6 \
       lc rgb word(blue." ".green." ".vermilion." ".purple, k + 1) \
       title "e = ".word("0 a/4 a/2 3a/4", k + 1)
unset multiplot
