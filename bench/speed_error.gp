# Time over error for contacts with a known answer, from speed_error.csv: speed_error.png.
folder = system("dirname '".ARG0."'")
load folder."/curves.gp"
eval picture("speed_error", 800, 1080)
panels = 'quartic cylinder wave flat tilted lifted sphere equal_sphere equal_light_area equal_heavy_area'
array heading[10] = ['quartic punch', 'cylinder', 'wavy surface', 'flat punch', 'flat punch, tilted', \
  'flat punch, lifting off', 'sphere on a half-space', 'solver alone: sphere', 'solver alone: rough, light', \
  'solver alone: rough, heavy']
array first[10] = [-1, -1, -1, -1, -1, -1, -2, -1, -1, -1]
array last[10] = [-16, -16, -16, -4, -4, -4, -5, -6, -6, -6]
array every[10] = [5, 5, 5, 1, 1, 1, 1, 1, 1, 1]
array fastest[10] = [5e-6, 5e-6, 5e-6, 5e-6, 5e-6, 5e-6, 5e-4, 2e-2, 2e-2, 2e-2]
array slowest[10] = [4, 4, 4, 4, 4, 4, 1e2, 1e2, 1e2, 1e2]
measure = 'relative error of the pressure'
rows = 4
keys = '1 2 4 5 12 13 11 14 15 6 7 8 9 16 17 18 10'
key_x(k) = k <= 9 ? 0.41 : 0.735
key_y(k) = k <= 9 ? 0.215 - 0.0225*(k - 1) : 0.215 - 0.0225*(k - 10)
load folder."/speed_panels.gp"
