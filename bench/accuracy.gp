# True errors and times of solves to a wanted error, from accuracy.csv: accuracy.png. Run in the folder of the table.
load system("dirname '".ARG0."'")."/../examples/plots/style.gp"
set datafile separator ','
set datafile missing NaN
eval picture("accuracy", 800, 440)
file = 'accuracy.csv'
# The three rows of a contact stand a little beside those of the others.
beside(wanted) = wanted*10.0**(0.022*(floor(column(0)/3.0) - 6.5))
of(kind, value) = strcol(2) eq kind ? value : NaN
given_up(value) = $4 > $3 ? value : NaN
# Errors of rounding are drawn at the lower end.
lowest = 2e-7
shown(error) = error > lowest ? error : lowest
set logscale xy
set format '10^{%L}'
set xlabel 'wanted error' offset 0, 0.3
set xrange [5e-5:6e-2]
set multiplot
eval panel(0.085, 0.485, 0.13, 0.92)
set title 'True error' offset 0, -0.3
set ylabel 'share of the load in the wrong place' offset 0.8
set yrange [1e-7:1e-1]
set key at graph 1.0, 0.36
plot x with lines ls KNOWN title 'wanted', \
     file using (of('line', beside($3))):(shown($5)) with points ls FUGE title 'lines', \
     file using (of('area', beside($3))):(shown($5)) with points ls FUGE_TOO title 'areas', \
     file using (given_up(beside($3))):(shown($5)) with points lc rgb black lw 1 pt 2 ps 1.2 \
       title 'not reached, with a warning'
eval panel(0.585, 0.985, 0.13, 0.92)
set title 'Time'
set ylabel 'time [s]'
set yrange [5e-6:1e4]
set key inside top left
plot file using (of('line', beside($3))):6 with points ls FUGE title 'lines, to the wanted error', \
     file using (of('area', beside($3))):6 with points ls FUGE_TOO title 'areas, to the wanted error', \
     file using (of('line', beside($3))):7 with points ls OTHER title 'lines, best grid known in hindsight', \
     file using (of('area', beside($3))):7 with points ls OTHER_TOO title 'areas, best grid known in hindsight', \
     file using (given_up(beside($3))):6 with points lc rgb black lw 1 pt 2 ps 1.2 \
       title 'not reached, with a warning'
unset multiplot
