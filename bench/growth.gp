# Time and memory over the number of points, from growth.csv: growth.png. Run in the folder of the table.
load system("dirname '".ARG0."'")."/curves.gp"
eval picture("growth", 800, 370)
# The tableau is in no other picture.
set linetype 16 lc rgb vermilion lw 2 pt 11 ps 0.75
names = 'tableau active_set iterative_dense iterative_fft'
array kind[4] = [16, 1, 3, 4]
array title[4] = ['tableau', 'active set', 'iteration, matrix', 'iteration, FFT']
of(engine, column) = strcol(1) eq engine ? column : NaN
set logscale xy
set format y '10^{%L}'
set xlabel 'points' offset 0, 0.3
set xtics ('2^{5}' 32, '2^{10}' 1024, '2^{15}' 32768, '2^{20}' 1048576)
set xrange [22:2e6]
set ytics 10
set mytics 1
set multiplot
eval panel(0.09, 0.485, 0.15, 0.90)
set title 'Time of a solve' offset 0, -0.3
set ylabel 'time [s]' offset 0.5
set yrange [1e-5:1e1]
set key bottom right
plot for [c = 1:4] 'growth.csv' using 2:(of(word(names, c), $3)) with linespoints lt kind[c] title title[c]
eval panel(0.585, 0.98, 0.15, 0.90)
set title 'Memory of matrix or operator, and solve'
set ylabel 'memory [MB]'
set yrange [0.5:2e3]
unset key
plot for [c = 1:4] 'growth.csv' using 2:(of(word(names, c), $5/1e6)) with linespoints lt kind[c]
unset multiplot
