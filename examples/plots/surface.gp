# A rough surface on a half-space: pressure, and real area of contact over load.
# Run in the folder of surface_map.dat and surface_load.csv.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("surface", 800, 370)
set multiplot

stats "surface_map.dat" matrix name "m" nooutput
n = m_size_x
eval panel(0.07, 0.42, 0.15, 0.89)
set size ratio -1
set border 15
set tics out
set title "Mean pressure 0.1 E* g: it touches in spots" offset 0, -0.3
set xlabel "x / period" offset 0, 0.3
set ylabel "y / period" offset 2.5
set xrange [0:1]
set yrange [0:1]
set xtics 1
set ytics 1
# Darker at its light end than elsewhere: most spots are small.
set palette defined (0 "#fdc98f", 0.35 "#fc8d59", 0.65 "#d7301f", 1 "#5a0000")
set cbrange [0:*]
set cbtics 0.05
set cblabel "pressure [E*]" offset 0
set colorbox user origin 0.435, 0.15 size 0.017, 0.74
plot "surface_map.dat" matrix using (($1 + 0.5)/n):(($2 + 0.5)/n):($3 > 0 ? $3 : NaN) with image notitle

set size noratio
unset colorbox
set border 3
set tics in nomirror scale 0.6
eval panel(0.64, 0.985, 0.15, 0.89)
set datafile separator comma
set key bottom right noreverse Right
set title "Real area A of A_0: between two theories"
set xlabel "p / (E* g),  g rms gradient" offset 0, 0.3
set ylabel "A / A_0" offset 0.5
set format "%g"
set logscale xy
set xrange [0.01:2.5]
set yrange [0.01:1.5]
set xtics autofreq nomirror
set ytics autofreq nomirror
bgt(p) = p < 0.2 ? sqrt(2*pi)*p : NaN
set samples 400
eval gridlines
plot bgt(x) with lines ls KNOWN lw 1.5 dt 2 title "Bush, Gibson, Thomas", \
     erf(sqrt(2)*x) with lines ls KNOWN title "Persson", \
     "surface_load.csv" using 1:2 every ::1 with points ls FUGE pt 6 title "fuge, cells in contact", \
     "" using 1:3 every ::1 with points ls FUGE title "less the cells' edges"
unset multiplot
