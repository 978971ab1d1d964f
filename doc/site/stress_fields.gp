# The figure of doc/theory_stress.md with the level lines of the largest shear stress in a half-plane, z |P'(x + i z)|:
#     gnuplot doc/site/stress_fields.gp        in the root of the repository
load system("dirname '".ARG0."'")."/../../examples/plots/style.gp"
set terminal svg size 800,600 font "sans-serif,13" enhanced background rgb "white"
set output "doc/stress_fields.svg"
i = {0, 1}
root(w) = sqrt(w - 1)*sqrt(w + 1)
# Under the mean pressure 1 on |x| < 1, or the line load 2 that has the same force.
line(w) = 2/(pi*w**2)
strip(w) = 2/(pi*(w**2 - 1))
hertz(w) = 4/pi*(1 - w/root(w))
flat(w) = 2*w/(pi*root(w)**3)
tau(f) = f > 2 ? 2 : f
names = "line strip hertz flat"
titles = "'Line load' 'Uniform pressure' 'Cylinder (Hertz)' 'Flat punch'"
set xrange [-2:2]
set yrange [0.0005:3]
set isosamples 161, 121
set samples 161
set contour base
set cntrparam levels discrete 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.5, 0.7, 1.0
unset surface
do for [k=1:4] {
  eval sprintf("set table $lines%d", k)
  eval sprintf("splot tau(y*abs(%s(x + i*y)))", word(names, k))
  unset table
}
unset contour
set multiplot
set border 15
unset grid
set tics out nomirror
unset key
set size ratio -1
set yrange [3:-0.15]
set xtics 1
set ytics 1
# Darker lines are higher levels.
set palette defined (0 "#8fbcdc", 0.5 "#2171b5", 1 "#062a57")
set logscale cb
set cbrange [0.05:1]
set cbtics (0.05, 0.1, 0.2, 0.4, 0.7, 1)
set cblabel "largest shear stress / p_m" offset 0.5
set colorbox user origin 0.87, 0.11 size 0.02, 0.82
do for [k=1:4] {
  column = (k - 1)%2
  row = (k - 1)/2
  eval panel(0.07 + 0.41*column, 0.43 + 0.41*column, 0.605 - 0.495*row, 0.93 - 0.495*row)
  set title word(titles, k) offset 0, -0.5
  set ylabel (column == 0 ? "z / a" : "") offset 1
  set xlabel "x / a" offset 0, 0.5
  data = sprintf("$lines%d", k)
  set label 1 "×" at 0, (k == 3 ? 0.786 : -9) center front textcolor rgb vermilion
  plot data using 1:2:3 with lines lw 1.4 lc palette, \
       "+" using 1:(k > 1 && abs($1) <= 1 ? 0 : NaN) with lines lw 5 lc rgb vermilion, \
       "+" using (k == 1 ? 0 : NaN):(0) every ::0::0 with points pt 7 ps 0.8 lc rgb vermilion
  unset colorbox
}
unset multiplot
