# Time over error, one panel a problem, from speed_error.csv:
#   gnuplot -e "kind='png'" speed_error.gp
set datafile separator ','
set datafile missing NaN
if (!exists('kind')) kind = 'png'
if (kind eq 'svg') {
  set terminal svg size 900,1250 font 'sans,11' background '#ffffff'
} else {
  set terminal pngcairo size 1800,2500 font 'sans,21' linewidth 2
}
set output 'speed_error.'.kind

# Colours that colour-blind readers can tell apart (Okabe and Ito); marks differ as well.
set linetype 1 lc rgb '#0072b2' lw 2.2 pt 7  ps 1.1
set linetype 2 lc rgb '#56b4e9' lw 2.2 pt 5  ps 0.9
set linetype 3 lc rgb '#0072b2' lw 1.6 pt 6  ps 1.5 dt (6,3)
set linetype 4 lc rgb '#009e73' lw 2.2 pt 9  ps 1.2
set linetype 5 lc rgb '#000000' lw 2.2 pt 15 ps 2.2
set linetype 6 lc rgb '#d55e00' lw 0.9 pt 4  ps 0.9
set linetype 7 lc rgb '#e69f00' lw 0.9 pt 8  ps 1.1
set linetype 8 lc rgb '#cc79a7' lw 0.9 pt 12 ps 1.1
set linetype 9 lc rgb '#8c564b' lw 0.9 pt 10 ps 1.1
set linetype 10 lc rgb '#999999' lw 0.9 pt 14 ps 1.1
set linetype 11 lc rgb '#a00000' lw 1.4 pt 3 ps 1.1 dt (3,2)
set linetype 12 lc rgb '#d55e00' lw 1.4 pt 13 ps 1.3 dt (6,3)
set linetype 13 lc rgb '#d55e00' lw 1.4 pt 12 ps 1.3
set linetype 14 lc rgb '#8c564b' lw 1.4 pt 11 ps 1.2

curves = 14
names = 'active_set graded iterative_dense iterative_fft smooth daqp piqp proxqp quadprog scipy_nnls tamaas '. \
  'aspher aspher_nested contactmechanics'
array title[14] = ['fuge: active set', 'fuge: active set, graded cells', 'fuge: iteration, matrix', \
  'fuge: iteration, FFT', 'fuge: smooth punch', 'DAQP', 'PIQP', 'ProxQP', 'quadprog', 'scipy nnls', 'Tamaas', \
  'ASPHER', 'ASPHER, nested grids', 'ContactMechanics']
panels = 'quartic cylinder wave flat tilted lifted random light heavy sphere light_area heavy_area'
array heading[12] = ['quartic punch', 'cylinder', 'wavy surface', 'flat punch', 'flat punch, tilted', \
  'flat punch, lifting off', 'random matrix', 'rough profile, light load', 'rough profile, heavy load', \
  'sphere on a half-space', 'rough surface, light load', 'rough surface, heavy load']

file = 'speed_error.csv'
at(panel, curve) = strcol(1) eq panel && strcol(2) eq curve
solved(panel, curve) = at(panel, curve) && strcol(6) eq 'solved' ? $4 : NaN
failed(panel, curve) = at(panel, curve) && strcol(6) ne 'solved' ? $4 : NaN

set logscale xy
set format y '10^{%L}'
set grid lc rgb '#dddddd' lw 0.5
set tics nomirror scale 0.5
set border 3
unset key
set ytics 10 offset 0.6,0
set multiplot
wide = 0.272
high = 0.162
do for [k = 1:12] {
  panel = word(panels, k)
  row = (k - 1)/3
  column = (k - 1)%3
  left = 0.070 + column*(wide + 0.045)
  top = 0.979 - row*(high + 0.0635)
  set lmargin at screen left
  set rmargin at screen left + wide
  set tmargin at screen top
  set bmargin at screen top - high
  set title heading[k] offset 0,-0.7
  set ylabel (column == 0 ? 'time, s' : '') offset 1.8,0
  set xlabel (row == 2 || k > 10 ? 'residual' : 'error of the pressure') offset 0,0.5
  if (row == 0) { set xrange [2e-1:1e-17]; every = 4; last = -17; set yrange [5e-6:20] }
  if (row == 1) { set xrange [2e-1:1e-4]; every = 1; last = -4; set yrange [5e-6:20] }
  if (row == 2) { set xrange [2e-1:1e-17]; every = 4; last = -17; set yrange [3e-3:60] }
  if (row == 3) { set xrange [2e-1:1e-14]; every = 3; last = -14; set yrange [1e-2:100] }
  if (k == 10) { set xrange [2e-2:1e-5]; every = 1; last = -5; set yrange [5e-4:200] }
  set xtics ('10^{-1}' 0.1)
  do for [power = -1:last:-every] { set xtics add (sprintf('10^{%d}', power) 10.0**power) }
  plot for [c = 1:curves] file using (solved(panel, word(names, c))):5 with linespoints lt c, \
       for [c = 1:curves] file using (failed(panel, word(names, c))):5 with points lt c pt 2 ps 1.6 lw 2
}
# The legend below the panels: the mark of each curve and its name.
set lmargin at screen 0.0
set rmargin at screen 1.0
set bmargin at screen 0.0
set tmargin at screen 0.084
unset title
unset xlabel
unset ylabel
unset border
unset tics
unset grid
unset logscale
set xrange [0:1]
set yrange [0:1]
array across[4] = [0.03, 0.345, 0.575, 0.735]
x(c) = across[1 + (c - 1)/4]
y(c) = 0.82 - 0.22*((c - 1)%4)
do for [c = 1:curves] { set label c title[c] at x(c) + 0.055, y(c) }
set label 15 'failed or out of time' at x(15) + 0.055, y(15)
plot for [c = 1:curves] '+' using (x(c) + 0.02*$0):(y(c)) every ::0::2 with linespoints lt c, \
     '+' using (x(15) + 0.02):(y(15)) every ::0::0 with points pt 2 ps 1.6 lw 2 lc rgb '#444444'
unset multiplot
