# A bolted flange: pressure on the joint, tightened and under internal pressure, and the force of the bolt.
# Run in the folder of flange_map.dat and flange.csv.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("flange", 800, 320)
set multiplot

# One pitch: the half that is modelled, and its mirror image.
set view map
set pm3d corners2color mean
# Open joints are grey.
set palette defined (0 "#dfe3e8", 0.001 "#fff1dd", 0.25 "#fdd49e", 0.5 "#fc8d59", 0.75 "#d7301f", 1 "#5a0000")
set cbrange [0:75]
set size ratio -1
unset border
unset tics
unset grid
unset key
unset colorbox
set xrange [45:120]
set yrange [-46:46]
eval panel(0.005, 0.235, 0.03, 0.88)
set label 1 "Tightened" at screen 0.12, 0.935 center
splot "flange_map.dat" using 1:2:3 with pm3d, "" using 1:(-$2):3 with pm3d
eval panel(0.255, 0.485, 0.03, 0.88)
set label 1 "and 30 N/mm^2 inside" at screen 0.37, 0.935 center
set colorbox user origin 0.50, 0.17 size 0.016, 0.60
set cblabel "pressure [N/mm^2]" offset 0.3
set cbtics 25
splot "flange_map.dat" using 1:2:4 with pm3d, "" using 1:(-$2):4 with pm3d
unset label 1
unset colorbox

set size noratio
set border 3
set xtics nomirror 20 scale 0.6
set ytics nomirror 40 scale 0.6
set grid xtics ytics lt 1 lw 0.6 lc rgb "#e2e2e2"
set datafile separator comma
eval panel(0.685, 0.985, 0.17, 0.87)
set title "Forces for one bolt" offset 0, -0.3
set xlabel "thrust of the pressure [kN]" offset 0, 0.3
set ylabel "force [kN]" offset 0.5
set xrange [0:95]
set yrange [0:160]
set key top left
plot "flange.csv" using 2:3 every ::1 with linespoints ls FUGE title "bolt", \
     "" using 2:4 every ::1 with linespoints ls FUGE_THIRD title "joint", \
     x with lines ls KNOWN lw 1.5 dt 2 title "thrust"
unset multiplot
