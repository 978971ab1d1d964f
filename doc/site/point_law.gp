# The figure of doc/theory.md with the law of a point, hard and with limits:
#     gnuplot doc/site/point_law.gp        in the root of the repository
load system("dirname '".ARG0."'")."/../../examples/plots/style.gp"
set terminal svg size 800,330 font "sans-serif,13" enhanced background rgb "white"
set output "doc/point_law.svg"
set multiplot
unset border
unset tics
set xrange [-1.6:3.1]
set yrange [-1.9:1.9]
unset key

set style arrow 1 head filled size screen 0.011,22 lc rgb grey lw 1.2
set style arrow 2 nohead lc rgb blue lw 3
set style arrow 3 nohead lc rgb grey lw 1 dt 3
set arrow 1 from -1.6, 0 to 3, 0 as 1
set arrow 2 from 0, -1.8 to 0, 1.85 as 1
set label 1 "gap c" at 3.05, -0.2 right tc rgb grey
set label 2 "force f" at -0.1, 1.75 right tc rgb grey

eval panel(0.01, 0.49, 0.02, 0.9)
set title "Hard contact between two stops" offset 0, -0.3
set arrow 3 from 0, 1.6 to 0, 0 as 2
set arrow 4 from 0, 0 to 1.5, 0 as 2
set arrow 5 from 1.5, 0 to 1.5, -1.6 as 2
set label 3 "d" at 1.5, 0.22 center
set label 4 "1: lower stop" at 0.12, 1.0
set label 5 "0: open" at 0.75, -0.25 center
set label 6 "-1: upper stop" at 1.62, -1.0
plot NaN

eval panel(0.51, 0.99, 0.02, 0.9)
set title "With limits of the force"
set arrow 3 from 0, 1.1 to 0, 0 as 2
set arrow 5 from 1.5, 0 to 1.5, -1.1 as 2
set arrow 6 from -1.3, 1.1 to 0, 1.1 as 2
set arrow 7 from 1.5, -1.1 to 2.8, -1.1 as 2
set arrow 8 from 0, -1.1 to 1.5, -1.1 as 3
set label 4 "1" at 0.12, 0.55
set label 5 "0" at 0.75, -0.25 center
set label 6 "-1" at 1.62, -0.55
set label 7 "2: limited" at -1.3, 1.32
set label 8 "-2: limited" at 2.15, -1.4 center
set label 9 "u" at 0.12, 1.15
set label 10 "-{/*1.2 ℓ}" at -0.12, -1.1 right
plot NaN
unset multiplot
