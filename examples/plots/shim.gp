# A shim in a bolted joint: pressures without and with it, and its thickness. Run in the folder of shim_map.dat.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("shim", 800, 330)
set multiplot

unset border
unset tics
unset key
set view map
set pm3d scansautomatic noborder corners2color mean
set size ratio -1
set xrange [45:120]
set yrange [-46:46]
set label 2 "bore" at graph 0.07, 0.06 center
set label 3 "rim" at graph 0.93, 0.06 center
# One pitch: the half that is modelled, and its mirror image. Open places are grey.
set palette defined (0 "#c9ced4", 0.001 "#fff1dd", 0.25 "#fdd49e", 0.5 "#fc8d59", 0.75 "#d7301f", 1 "#5a0000")
set cbrange [0:3]
unset colorbox
eval panel(0.005, 0.265, 0.03, 0.86)
set label 1 "Tightened, without a shim" at screen 0.135, 0.93 center
splot "shim_map.dat" using 1:2:4 with pm3d, "" using 1:(-$2):4 with pm3d
eval panel(0.275, 0.535, 0.03, 0.86)
set label 1 "With a shim" at screen 0.405, 0.93 center
set colorbox user origin 0.55, 0.22 size 0.014, 0.5
set cbtics 1 scale 0.6
set cblabel "pressure over its mean" offset 0.4
splot "shim_map.dat" using 1:2:8 with pm3d, "" using 1:(-$2):8 with pm3d
set palette defined (0 "#f7fbff", 0.25 "#c6dbef", 0.5 "#6baed6", 0.75 "#2171b5", 1 "#08306b")
set cbrange [0:60]
set cbtics 20
set cblabel "thickness [{/Symbol m}m]" offset 0.4
set colorbox user origin 0.915, 0.22 size 0.014, 0.5
eval panel(0.645, 0.905, 0.03, 0.86)
set label 1 "Thickness, at most 60 {/Symbol m}m" at screen 0.775, 0.93 center
splot "shim_map.dat" using 1:2:7 with pm3d, "" using 1:(-$2):7 with pm3d
unset multiplot
