# Wrong answers and no answers of rules that switch members, over the number of cables, from one_sided.csv:
# one_sided.png. Run in the folder of the table.
load system("dirname '".ARG0."'")."/../examples/plots/style.gp"
set datafile separator ','
set datafile missing NaN
eval picture("one_sided", 800, 330)
names = 'drop_all drop_worst take_back fuge'
array style[4] = [OTHER, OTHER_TOO, OTHER_THIRD, FUGE]
array title[4] = ['dropped for good', 'one by one for good', 'dropped and taken back', 'fuge']
of(rule, share) = strcol(2) eq rule ? share : NaN
set xlabel 'cables' offset 0, 0.3
set xrange [0:64]
set xtics 10
set format y '%g %%'
set multiplot
eval panel(0.085, 0.485, 0.165, 0.90)
set title 'Wrong forces, silently' offset 0, -0.3
set yrange [-3:100]
set key top left
plot for [c = 1:4] 'one_sided.csv' using 1:(of(word(names, c), 100.0*$4/$3)) with linespoints ls style[c] title title[c]
eval panel(0.585, 0.985, 0.165, 0.90)
set title 'No forces: unstable on the way, or endless'
set yrange [-0.3:10]
unset key
plot for [c = 1:4] 'one_sided.csv' using 1:(of(word(names, c), 100.0*($5 + $6)/$3)) with linespoints ls style[c]
unset multiplot
