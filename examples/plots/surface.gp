# A rough surface on a half-space: pressure, and real area of contact over load.
# Run in the folder of surface_map.dat and surface_load.csv.
set terminal pngcairo size 1200,520 font "sans,13" enhanced
set output "surface.png"
set multiplot

stats "surface_map.dat" matrix name "m" nooutput
n = m_size_x
set lmargin at screen 0.045
set rmargin at screen 0.42
set tmargin at screen 0.92
set bmargin at screen 0.055
set size ratio -1
set border 15
unset tics
set title "Pressure [E*], mean 0.1 E* g"
set xrange [-0.5:n - 0.5]
set yrange [-0.5:n - 0.5]
set palette defined (0 "#fad7a0", 0.4 "#e67e22", 0.7 "#a93226", 1 "#4a0e0b")
set cbrange [0:*]
set palette maxcolors 16
set cbtics
set colorbox user origin 0.432, 0.055 size 0.014, 0.865
plot "surface_map.dat" matrix using 1:2:($3 > 0 ? $3 : NaN) with image notitle

set size noratio
unset colorbox
set border 3
set tics nomirror
set lmargin at screen 0.575
set rmargin at screen 0.985
set bmargin at screen 0.125
set datafile separator comma
set key bottom right
set grid lc rgb "#dddddd"
set title "Real area of contact"
set xlabel "p / (E* g)"
set ylabel "A / A_0"
set logscale xy
set xrange [0.01:2.5]
set yrange [0.01:1.3]
set xtics autofreq
set ytics autofreq
bgt(p) = p < 0.2 ? sqrt(2*pi)*p : NaN
set samples 400
plot bgt(x) with lines dt 2 lw 1.5 lc rgb "#1f4e79" title "Bush, Gibson, Thomas: κ = √(2π)", \
     erf(sqrt(2)*x) with lines lw 2 lc rgb "#999999" title "Persson: erf(√2 p/(E* g)), κ = √(8/π)", \
     "surface_load.csv" using 1:2 every ::1 with points pt 6 ps 0.9 lc rgb "#c0392b" title "fuge, cells in contact", \
     "" using 1:3 every ::1 with points pt 7 ps 0.9 lc rgb "#c0392b" title "fuge, less the edges of the cells"
unset multiplot
