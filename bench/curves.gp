# The curves of the measurements: colour, mark and name of each engine and solver. fuge's lines are thick and its marks
# full, those of other codes thin and open.
load system("dirname '".ARG0."'")."/../examples/plots/style.gp"
set datafile separator ','
set datafile missing NaN
set linetype 1 lc rgb blue lw 2 pt 7 ps 0.6
set linetype 2 lc rgb sky lw 2 pt 5 ps 0.55
set linetype 3 lc rgb purple lw 2 pt 13 ps 0.8
set linetype 4 lc rgb green lw 2 pt 9 ps 0.75
set linetype 5 lc rgb black lw 2 pt 15 ps 1.1
set linetype 6 lc rgb vermilion lw 1 pt 4 ps 0.55
set linetype 7 lc rgb orange lw 1 pt 8 ps 0.65
set linetype 8 lc rgb "#b5a000" lw 1 pt 12 ps 0.75
set linetype 9 lc rgb brown lw 1 pt 10 ps 0.65
set linetype 10 lc rgb grey lw 1 pt 6 ps 0.6
set linetype 11 lc rgb wine lw 1 dt (4, 2) pt 3 ps 0.6
set linetype 12 lc rgb vermilion lw 1 pt 12 ps 0.75
set linetype 13 lc rgb orange lw 1 dt (6, 3) pt 14 ps 0.7
set linetype 14 lc rgb black lw 1 pt 1 ps 0.7
# A solve that failed.
set linetype 15 lc rgb '#444444' lw 1.5 pt 2 ps 0.8
set linetype 16 lc rgb blue lw 1 dt (4, 2) pt 4 ps 0.5
set linetype 17 lc rgb purple lw 1 dt (6, 3) pt 8 ps 0.6
set linetype 18 lc rgb green lw 1 dt (2, 2) pt 10 ps 0.6
curves = 18
names = 'active_set graded iterative_dense iterative_fft smooth daqp piqp proxqp quadprog scipy_nnls tamaas '. \
  'aspher_nested aspher contactmechanics failed highs clarabel osqp'
array title[18] = ['fuge: active set', 'fuge: active set, graded cells', 'fuge: iteration, matrix', \
  'fuge: iteration, FFT', 'fuge: smooth punch', 'DAQP', 'PIQP', 'ProxQP', 'quadprog', 'scipy nnls', 'Tamaas', \
  'ASPHER, nested grids', 'ASPHER', 'ContactMechanics', 'failed, or out of time', 'HiGHS', 'Clarabel', 'OSQP']
