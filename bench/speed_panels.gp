# Panels of time over error or residual, three a row, and the key of the curves below them or beside the last ones.
# Loaded by speed_error.gp and speed_residual.gp, which say: panels, heading, first, last, every (decades of each
# axis), fastest, slowest, measure, rows, keys (the curves in the key), key_x, key_y (the place of each).
file = 'speed_error.csv'
at(panel, curve) = strcol(1) eq panel && strcol(2) eq curve
solved(panel, curve) = at(panel, curve) && strcol(6) eq 'solved' ? $4 : NaN
failed(panel, curve) = at(panel, curve) && strcol(6) ne 'solved' ? $4 : NaN

set logscale xy
set format y '10^{%L}'
unset key
set grid xtics ytics mxtics lt 1 lw 0.6 lc rgb '#dddddd', lt 1 lw 0.5 lc rgb '#eeeeee'
set multiplot
do for [k = 1:words(panels)] {
  name = word(panels, k)
  row = (k - 1)/3
  column = (k - 1)%3
  eval panel(0.085 + 0.315*column, 0.34 + 0.315*column, 1 - (row + 0.78)/rows, 1 - (row + 0.10)/rows)
  set title heading[k] offset 0, -0.5
  set ylabel (column == 0 ? 'time [s]' : '') offset 0.7
  set xlabel measure offset 0, 0.5
  # The error falls from left to right. A mark for each decade, a number for each `every` decades.
  set xrange [2*10.0**first[k]:0.5*10.0**last[k]]
  set yrange [fastest[k]:slowest[k]]
  set xtics () nomirror
  do for [power = first[k]:last[k]:-1] {
    numbered = (power - first[k])%every[k] == 0
    set xtics add (numbered ? sprintf('10^{%d}', power) : '' 10.0**power numbered ? 0 : 1)
  }
  set ytics 10 nomirror
  set mytics 10
  plot for [c = 1:curves] file using (solved(name, word(names, c))):5 with linespoints lt c, \
       for [c = 1:curves] file using (failed(name, word(names, c))):5 with points lt 15 lc c
}
eval panel(0, 1, 0, 1)
unset title
unset xlabel
unset ylabel
unset border
unset tics
unset grid
unset logscale
set xrange [0:1]
set yrange [0:1]
mark(k) = int(word(keys, k))
do for [k = 1:words(keys)] { set label k title[mark(k)] at key_x(k) + 0.06, key_y(k) }
plot for [k = 1:words(keys)] '+' using (key_x(k) + 0.02*$0):(key_y(k)) every ::0::(mark(k) == 15 ? 0 : 2) \
       with linespoints lt mark(k)
unset multiplot
