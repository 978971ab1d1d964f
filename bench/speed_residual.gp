# Time over residual for problems without a known answer, from speed_error.csv: speed_residual.png.
folder = system("dirname '".ARG0."'")
load folder."/curves.gp"
eval picture("speed_residual", 800, 510)
panels = 'random light heavy light_area heavy_area'
array heading[5] = ['random matrix', 'rough profile, light load', 'rough profile, heavy load', \
  'rough surface, light load', 'rough surface, heavy load']
array first[5] = [-1, -1, -1, -1, -1]
array last[5] = [-16, -16, -16, -16, -16]
array every[5] = [5, 5, 5, 5, 5]
array fastest[5] = [5e-4, 1e-2, 1e-2, 1e-2, 1e-2]
array slowest[5] = [1e2, 1e2, 1e2, 1e2, 1e2]
measure = 'scaled residual'
rows = 2
keys = '1 3 4 6 7 8 9 16 17 18 10 11 12 13 14 15'
key_x(k) = 0.725
key_y(k) = 0.455 - 0.029*(k - 1)
load folder."/speed_panels.gp"
