# A rough profile on a half-plane: where it touches, and real contact length over load.
# Run in the folder of rough_window.csv and rough_load.csv.
set terminal pngcairo size 1200,520 font "sans,13" enhanced
set output "rough.png"
set datafile separator comma
set border 3
set tics nomirror
set multiplot

# Heights and pressures above each other, over the same cells.
set lmargin at screen 0.08
set rmargin at screen 0.485
set key bottom left Left reverse
stats "rough_window.csv" using 1:2 every ::1 name "w" nooutput
set xrange [w_min_x*1e3:w_max_x*1e3]
set tmargin at screen 0.92
set bmargin at screen 0.50
set title "Where the profile touches, mean pressure p = 0.01 E*"
set ylabel "height [L/1000]" offset 1
set format x ""
plot "rough_window.csv" using ($1*1e3):($2*1e3) every ::1 with filledcurves y1=w_min_y*1e3 \
       fillcolor rgb "#d5d8dc" notitle, \
     "" using ($1*1e3):($2*1e3) every ::1 with lines lw 1.5 lc rgb "#555555" title "profile", \
     "" using ($1*1e3):($3*1e3) every ::1 with lines lw 2 lc rgb "#2471a3" title "elastic surface"
unset title
unset key
set tmargin at screen 0.44
set bmargin at screen 0.125
set format x
set xlabel "x [L/1000]"
set ylabel "pressure [E*]" offset 1
set yrange [0:*]
set ytics 0.1
plot "rough_window.csv" using ($1*1e3):4 every ::1 with filledcurves y1=0 fillcolor rgb "#c0392b" notitle

set lmargin at screen 0.575
set rmargin at screen 0.985
set tmargin at screen 0.92
set key top left Left reverse
set grid lc rgb "#dddddd"
set title "Real contact length"
set xlabel "p / (E* h')"
set ylabel "A / A_0"
set logscale xy
set ytics autofreq
set xrange [1e-3:1]
set yrange [1e-3:1]
set format "10^{%T}"
plot [p=1e-3:1.2] erf(sqrt(2)*p) with lines lw 2 lc rgb "#999999" title "Persson, erf(√2 p/(E* h'))", \
     2*p with lines dt 2 lw 1.5 lc rgb "#999999" title "linear, κ = 2", \
     "rough_load.csv" using ($1/$9):2 every ::1 with points pt 7 ps 0.9 lc rgb "#c0392b" title "fuge"
unset multiplot
set ytics 0.1
