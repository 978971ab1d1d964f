# Punches under an eccentric force: contact length over the eccentricity, pressure, and errors.
# Run in the folder of tilt_length.csv, tilt_pressure.csv and tilt_error.csv.
set terminal pngcairo size 1680,480 font "sans,13" enhanced
set output "tilt.png"
set datafile separator ","
set multiplot layout 1,3
set border 3
set tics nomirror
set grid lc rgb "#dddddd"

set title "Contact length over the eccentricity"
set xlabel "e / a"
set ylabel "length / 2a"
set xrange [0:1]
set yrange [0:1.1]
set key bottom left
plot "tilt_length.csv" using (strcol(1) eq "flat" ? $2 : NaN):4 with lines lw 2 lc rgb "#999999" title "exact", \
     "" using (strcol(1) eq "rounded" ? $2 : NaN):4 with lines lw 2 lc rgb "#999999" notitle, \
     "" using (strcol(1) eq "flat" ? $2 : NaN):3 with points pt 7 ps 0.8 lc rgb "#c0392b" title "flat punch", \
     "" using (strcol(1) eq "rounded" ? $2 : NaN):3 with points pt 7 ps 0.8 lc rgb "#2471a3" title "rounded punch"

# Full contact up to e = a/2, beyond it a contact of half length b = 2 (a - e) at the corner.
a = 10.0
F = 5000.0
full(x, e) = F*(1 + 2*e*x/a**2)/(pi*sqrt(a**2 - x**2))
b(e) = 2*(a - e)
lifted(x, e) = x > a - 2*b(e) ? F/(pi*b(e))*sqrt((x - a + 2*b(e))/(a - x)) : 0
p(x, e) = abs(x) >= a ? NaN : (e > a/2 ? lifted(x, e) : full(x, e))
set title "Pressure under the flat punch, F = 5 kN/mm"
set xlabel "x [mm]"
set ylabel "pressure [N/mm^2]"
set xrange [-10:10]
set yrange [0:900]
set samples 1001
set key top left Left reverse
plot for [k=0:3] p(x, 0.25*k*a) with lines lw 2 lc rgb "#cccccc" notitle, \
     for [k=0:3] "tilt_pressure.csv" using 1:k+2 with points pt 7 ps 0.5 \
       lc rgb word("#2471a3 #1e8449 #b9770e #c0392b", k + 1) title word("e=0 e=a/4 e=a/2 e=3a/4", k + 1)

set title "Errors over the number of cells"
set xlabel "cells"
set ylabel "relative error"
set logscale xy
set xrange [32:524288]
set yrange [1e-11:100]
set xtics ("2^6" 64, "2^{10}" 1024, "2^{14}" 16384, "2^{18}" 262144)
set mxtics 1
set mytics 1
set format y "10^{%L}"
set key top right noreverse Right
at(name, e, column) = strcol(1) eq name && abs($2 - e) < 0.01 ? column : NaN
plot "tilt_error.csv" using 3:(at("flat", 0.72, $4)) with linespoints pt 7 ps 0.8 lc rgb "#c0392b" title "flat, e=0.72a: rotation", \
     "" using 3:(at("flat", 0.72, $6)) with linespoints pt 6 ps 0.8 lc rgb "#c0392b" title "pressure in the middle", \
     "" using 3:(at("rounded", 0.25, $5)) with linespoints pt 7 ps 0.8 lc rgb "#2471a3" title "rounded, e=0.25a: approach", \
     "" using 3:(at("rounded", 0.25, $6)) with linespoints pt 6 ps 0.8 lc rgb "#2471a3" title "pressure in the middle"
unset multiplot
