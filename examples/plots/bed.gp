# A beam on a bed that does not pull: contact length, shapes, and the pressure of a bed that gives way.
# Run in the folder of bed_length.csv, bed_shape.csv and bed_limit.csv.
load system("dirname '".ARG0."'")."/style.gp"
eval picture("bed", 800, 640)
set datafile separator ","
set multiplot

eval panel(0.085, 0.48, 0.58, 0.95)
set title "Longer than {/Symbol p}/{/Symbol l}, the beam lifts off" offset 0, -0.3
set xlabel "length [1/{/Symbol l}]" offset 0, 0.3
set ylabel "contact / length" offset 1
set xrange [1:7]
set yrange [0:1.1]
set key bottom left
eval gridlines
plot "bed_length.csv" using 1:3 with lines ls KNOWN title "closed form", \
     "" using 1:2 with points ls FUGE title "fuge"

eval panel(0.58, 0.97, 0.58, 0.95)
set title "Forces F press the ends down"
set xlabel "from the middle [1/{/Symbol l}]"
set ylabel "depth in the bed [F {/Symbol l}/k]"
set xrange [-2.6:2.6]
set yrange [2.6:-1.8]
set key at graph 0.5, 0.03 center bottom
eval gridlines
plot for [k=1:3] "bed_shape.csv" using (abs($1 - real(word("2 3.1416 5", k))) < 0.01 ? $2 : NaN):3 \
       with points pt int(word("7 9 13", k)) ps 0.6 lc rgb word(blue." ".green." ".vermilion, k) \
       title "length ".word("2 {/Symbol=11p} 5", k), \
     0 with lines lc rgb grey lw 1 notitle

eval panel(0.085, 0.97, 0.085, 0.445)
set title "Length 3: a bed of limited strength gives way from the ends on"
set ylabel "pressure of the bed [F {/Symbol l}]" offset 0.5
set xrange [-1.5:1.5]
set yrange [0:2]
set key at graph 0.5, 0.98 center top
eval gridlines
plot for [k=1:4] "bed_limit.csv" using (abs($1 - real(word("2 1.2 0.9 0.7", k))) < 0.01 ? $2 : NaN):3 \
       with points pt int(word("7 9 13 5", k)) ps 0.6 lc rgb word(blue." ".green." ".vermilion." ".purple, k) \
       title "strength ".word("2 1.2 0.9 0.7", k)
unset multiplot
