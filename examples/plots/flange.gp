# A bolted flange under internal pressure: the deformed bodies, pressure on the joint, and the force of the bolt.
# Run in the folder of flange_outside.dat, flange_cut.dat, flange_map.dat and flange.csv.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("flange", 800, 760)
set multiplot

# Half of the ring, cut through two bolts: eight half pitches, every other one a mirror image.
scale = 150.0
turn(j) = pi/4*((j + 1)/2)
side(j) = j % 2 == 0 ? 1 : -1
set pm3d depthorder border lw 0.15 lc rgb "#806f6f6f"
set pm3d lighting primary 0.35 specular 0
set view 66, 12, 3.1, 1.0
set view equal xyz
set size 1, 1
unset border
unset tics
unset key
set xrange [-120:120]
set yrange [0:120]
set zrange [-95:115]
# From blue, downwards, to red, upwards.
set palette defined (-1 "#2166ac", -0.5 "#92c5de", 0 "#f7f7f7", 0.5 "#f4a582", 1 "#b2182b")
set cbrange [-0.05:0.05]
set cbtics 0.025 format "%.3f"
set cblabel "displacement along the axis [mm]" offset 0.5
set colorbox user origin 0.85, 0.53 size 0.02, 0.36
set label 1 sprintf("Half of the ring, 30 N/mm^2 inside, displacements × %.0f: the joint opens at the bore", scale) \
  at screen 0.5, 0.965 center
eval panel(0.03, 0.82, 0.45, 0.95)
along(x, y, j) = x*cos(turn(j)) - side(j)*y*sin(turn(j))
across(x, y, j) = x*sin(turn(j)) + side(j)*y*cos(turn(j))
splot for [j=0:7] "flange_outside.dat" using (along($1 + scale*$4, $2 + scale*$5, j)): \
        (across($1 + scale*$4, $2 + scale*$5, j)):($3 + scale*$6):6 with pm3d, \
      for [j=0:7:7] "flange_cut.dat" using (along($1 + scale*$4, $2 + scale*$5, j)): \
        (across($1 + scale*$4, $2 + scale*$5, j)):($3 + scale*$6):6 with pm3d

# The joint of one pitch: the half that is modelled, and its mirror image.
set view noequal
set view map
set pm3d nolighting scansautomatic noborder
set pm3d corners2color mean
# Open joints are grey.
set palette defined (0 "#c9ced4", 0.001 "#fff1dd", 0.25 "#fdd49e", 0.5 "#fc8d59", 0.75 "#d7301f", 1 "#5a0000")
set cbrange [0:75]
set cbtics 25 format "%g"
set size ratio -1
unset colorbox
set xrange [45:120]
set yrange [-46:46]
set zrange [*:*]
eval panel(0.005, 0.235, 0.05, 0.375)
set label 1 "Joint of one bolt, tightened" at screen 0.12, 0.40 center
set label 2 "bore" at screen 0.025, 0.065 center
set label 3 "rim" at screen 0.225, 0.065 center
splot "flange_map.dat" using 1:2:3 with pm3d, "" using 1:(-$2):3 with pm3d
eval panel(0.255, 0.485, 0.05, 0.375)
set label 1 "with 30 N/mm^2 inside" at screen 0.37, 0.40 center
unset label 2
unset label 3
set colorbox user origin 0.50, 0.11 size 0.016, 0.21
set label 2 "open" at screen 0.518, 0.085 left
set object 1 rectangle center screen 0.508, 0.085 size screen 0.016, 0.016 fillcolor rgb "#c9ced4" \
  fillstyle solid noborder
set cblabel "pressure [N/mm^2]" offset 0.3
splot "flange_map.dat" using 1:2:4 with pm3d, "" using 1:(-$2):4 with pm3d
unset label
unset object
unset colorbox

set size noratio
set border 3
set xtics nomirror 20 scale 0.6
set ytics nomirror 40 scale 0.6
set datafile separator comma
# The load from which on the joint is open up to the hole of the bolt, 106 mm on its far side.
stats "flange.csv" using ($7 > 100 ? $2 : NaN) every ::1 name "o" nooutput
eval panel(0.685, 0.985, 0.085, 0.375)
set title "Bolt: constant until the joint opens" offset 0, -0.3
set xlabel "thrust of the pressure [kN]" offset 0, 0.3
set ylabel "force [kN]" offset 0.5
set xrange [0:95]
set yrange [0:160]
eval gridlines
set key top left
set arrow 1 from o_min, 0 to o_min, 112 nohead dt 3 lw 1 lc rgb "#555555"
set label 1 "joint open up\nto the bolt" at o_min + 2, 22 left textcolor rgb "#555555"
plot "flange.csv" using 2:3 every ::1 with linespoints ls FUGE title "bolt", \
     "" using 2:4 every ::1 with linespoints ls FUGE_THIRD title "joint", \
     x with lines ls KNOWN lw 1.5 dt 2 title "thrust"
unset multiplot
