# A raft on soil that does not pull: pressure in one load case, and that of the edge over the eccentricity of the load.
# Run in the folder of raft_pressure.csv and raft_edge.csv.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("raft", 800, 370)
set datafile separator comma
set multiplot

eval panel(0.07, 0.42, 0.15, 0.89)
set size ratio -1
set border 15
set tics out
set title "Wind at 36 degrees: nearly half of it lifts off" offset 0, -0.3
set xlabel "x [m]" offset 0, 0.3
set ylabel "y [m]" offset 1.5
set xrange [-9:9]
set yrange [-9:9]
set xtics 6
set ytics 6
eval pressures
set cbrange [0:*]
set cbtics 50
set cblabel "pressure of the soil [kN/m^2]" offset 0.5
set colorbox user origin 0.435, 0.15 size 0.017, 0.74
set arrow 1 from 0, 0 to 3*cos(pi/5), 3*sin(pi/5) lw 1.5 filled front
set key off
plot "raft_pressure.csv" using 1:2:($3 > 0 ? $3 : NaN) every ::1 with image

unset arrow 1
set size noratio
unset colorbox
set border 3
set tics in nomirror scale 0.6
eval panel(0.64, 0.985, 0.15, 0.89)
set key top left
set title "Wind along a side: pressure of the edge"
set xlabel "eccentricity / side of the raft" offset 0, 0.3
set ylabel "pressure / mean of the raft" offset 0
set format "%g"
set xrange [0:0.4]
set yrange [0:6]
set xtics 0.1 nomirror
set ytics 1 nomirror
rigid(e) = e < 1.0/6 ? 1 + 6*e : 2/(3*(0.5 - e))
set samples 400
eval gridlines
plot rigid(x) with lines ls KNOWN title "rigid raft, exact", \
     "raft_edge.csv" using 1:3 every ::1 with points ls FUGE title "hardly bends", \
     "" using 1:4 every ::1 with points ls FUGE_TOO title "concrete, 1.5 m"
unset multiplot
