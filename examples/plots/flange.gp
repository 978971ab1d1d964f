# A bolted flange: pressure on the joint, tightened and under internal pressure, and the force of the bolt.
# Run in the folder of flange_map.dat and flange.csv.
set terminal pngcairo size 1500,500 font "sans,13" enhanced
set output "flange.png"
set multiplot

# One pitch: the half that is modelled, and its mirror image.
set view map
set pm3d corners2color mean
set palette defined (0 "#f4f6f7", 0.001 "#d6eaf8", 0.35 "#5dade2", 0.7 "#1f4e79", 1 "#0b1f33")
set cbrange [0:75]
set size ratio -1
unset border
unset tics
unset key
unset colorbox
set xrange [45:120]
set yrange [-46:46]
set tmargin at screen 0.88
set bmargin at screen 0.06
set lmargin at screen 0.00
set rmargin at screen 0.26
set label 1 "Pressure on the joint, tightened" at screen 0.14, 0.945 center
splot "flange_map.dat" using 1:2:3 with pm3d, "" using 1:(-$2):3 with pm3d
set lmargin at screen 0.28
set rmargin at screen 0.54
set label 1 "and under 30 N/mm^2 inside" at screen 0.42, 0.945 center
set colorbox user origin 0.565, 0.15 size 0.012, 0.65
set cblabel "N/mm^2"
set cbtics 25
splot "flange_map.dat" using 1:2:4 with pm3d, "" using 1:(-$2):4 with pm3d
unset label 1
unset colorbox

set size noratio
set border 3
set xtics nomirror autofreq
set ytics nomirror autofreq
set grid xtics ytics lt 1 lc rgb "#dddddd"
set datafile separator comma
set lmargin at screen 0.69
set rmargin at screen 0.985
set tmargin at screen 0.90
set bmargin at screen 0.13
set title "Forces for one bolt"
set xlabel "thrust of the internal pressure [kN]"
set ylabel "kN" offset 1
set xrange [0:95]
set yrange [0:145]
set key top left Left reverse
plot "flange.csv" using 2:3 every ::1 with linespoints pt 7 ps 0.9 lw 2 lc rgb "#c0392b" title "bolt", \
     "" using 2:4 every ::1 with linespoints pt 6 ps 0.9 lw 2 lc rgb "#1f4e79" title "joint", \
     x with lines lw 1.5 dt 2 lc rgb "#777777" title "thrust"
unset multiplot
