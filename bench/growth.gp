# Time and memory over the number of points, from growth.csv:
#   gnuplot -e "kind='png'" growth.gp
set datafile separator ','
set datafile missing NaN
if (!exists('kind')) kind = 'png'
if (kind eq 'svg') {
  set terminal svg size 900,380 font 'sans,12' background '#ffffff'
} else {
  set terminal pngcairo size 1800,760 font 'sans,22' linewidth 2
}
set output 'growth.'.kind
set linetype 1 lc rgb '#d55e00' lw 2 pt 4 ps 1.2
set linetype 2 lc rgb '#0072b2' lw 2 pt 7 ps 1.1
set linetype 3 lc rgb '#56b4e9' lw 2 pt 6 ps 1.1
set linetype 4 lc rgb '#009e73' lw 2 pt 9 ps 1.2
names = 'tableau active_set iterative_dense iterative_fft'
array title[4] = ['tableau', 'active set', 'iteration, matrix', 'iteration, FFT']
of(engine, column) = strcol(1) eq engine ? column : NaN
set logscale xy
set format y '10^{%L}'
set grid lc rgb '#dddddd' lw 0.5
set tics nomirror scale 0.5
set border 3
set xlabel 'points'
set xtics ('2^{5}' 32, '2^{10}' 1024, '2^{15}' 32768, '2^{20}' 1048576)
set xrange [22:1.5e6]
set key bottom right Left reverse samplen 2.5
set multiplot layout 1,2
set title 'time of a solve, s'
plot for [c = 1:4] 'growth.csv' using 2:(of(word(names, c), $3)) with linespoints lt c title title[c]
set title 'matrix or operator, and solve: memory, MB'
unset key
plot for [c = 1:4] 'growth.csv' using 2:(of(word(names, c), $5/1e6)) with linespoints lt c
unset multiplot
