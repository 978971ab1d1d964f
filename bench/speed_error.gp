# Time over error for contacts with a known answer, from speed_error.csv: speed_error.png.
folder = system("dirname '".ARG0."'")
load folder."/curves.gp"
eval picture("speed_error", 800, 840)
panels = 'quartic cylinder wave flat tilted lifted sphere'
array heading[7] = ['quartic punch', 'cylinder', 'wavy surface', 'flat punch', 'flat punch, tilted', \
  'flat punch, lifting off', 'sphere on a half-space']
array first[7] = [-1, -1, -1, -1, -1, -1, -2]
array last[7] = [-16, -16, -16, -4, -4, -4, -5]
array every[7] = [5, 5, 5, 1, 1, 1, 1]
array fastest[7] = [5e-6, 5e-6, 5e-6, 5e-6, 5e-6, 5e-6, 5e-4]
array slowest[7] = [4, 4, 4, 4, 4, 4, 1e2]
measure = 'relative error of the pressure'
rows = 3
keys = '1 2 4 5 15 6 7 8 9 10 11 12 13 14'
key_x(k) = k <= 5 ? 0.40 : 0.735
key_y(k) = k <= 5 ? 0.29 - 0.029*(k - 1) : 0.29 - 0.029*(k - 6)
load folder."/speed_panels.gp"
