# --surface: surfaces with known answers, and what the program says of wrong ones.
add_executable(program_surfaces surfaces.f90)
set_target_properties(program_surfaces PROPERTIES
  Fortran_MODULE_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}/modules_surfaces")
target_link_libraries(program_surfaces PRIVATE fuge::fuge)
fuge_set_warnings(program_surfaces)
set(folder "${CMAKE_CURRENT_BINARY_DIR}/surfaces")
file(MAKE_DIRECTORY "${folder}")
add_test(NAME program_surface_files COMMAND program_surfaces write "${folder}")
set_tests_properties(program_surface_files PROPERTIES FIXTURES_SETUP program_surfaces)

# program_solves_surface(name case field arguments ..)
function(program_solves_surface name case field)
  list(JOIN ARGN "|" arguments)
  add_test(NAME program_surface_${name} COMMAND "${CMAKE_COMMAND}" -DPROGRAM=$<TARGET_FILE:fuge_program>
      -DSURFACES=$<TARGET_FILE:program_surfaces> "-DARGUMENTS=${arguments}" -DNAME=${name} -DCASE=${case}
      -DFIELD=${field}
      -P "${CMAKE_CURRENT_SOURCE_DIR}/run_surface.cmake" WORKING_DIRECTORY "${folder}")
  set_tests_properties(program_surface_${name} PROPERTIES FIXTURES_REQUIRED program_surfaces)
endfunction()

function(surface_refuses name message)
  program_refuses(surface_${name} MESSAGE "${message}" ARGUMENTS ${ARGN})
  set_tests_properties(program_refuses_surface_${name} PROPERTIES FIXTURES_REQUIRED program_surfaces
    WORKING_DIRECTORY "${folder}")
endfunction()

set(free --boundary free --load 100 --modulus 115385)
if(FUGE_WITH_FFTW)
  # The same ball in nine ways.
  program_solves_surface(grid ball grid_map.csv --surface ball.txt ${free} --level none)
  program_solves_surface(centre ball centre.vti --surface ball.txt ${free} --level mean --element centre)
  program_solves_surface(sdf ball sdf_map.csv --surface ball.sdf ${free} --scale 1e3 --level mean)
  program_solves_surface(columns ball "" --surface columns.txt ${free} --height-scale 1e-3 --level mean)
  program_solves_surface(spacing ball "" --surface plain.txt ${free} --spacing 0.0035 --level mean)
  program_solves_surface(filled ball "" --surface holes.txt ${free} --fill --level none)
  program_solves_surface(threads ball "" --surface ball.txt ${free} --level none --threads 3)
  # A job file, whose paths begin at its folder.
  file(WRITE "${folder}/job.txt"
    "surface ball.txt\nboundary free\nlevel none\nload 100   # N\nmodulus 115385\n")
  program_solves_surface(job ball "" "${folder}/job.txt")
  # The mean pressure of 100 N; two bodies of one material; a plane to take out, which is the default.
  program_solves_surface(tilted ball "" --surface tilted.txt --boundary free --pressure 557.5620043796496
    --young 210000.7,210000.7 --poisson 0.3,0.3)
  # A quarter and a half of complete contact, pi E* A, and one and a half of it.
  program_solves_surface(wave wave "" --surface wave.txt --level none --modulus 115385
    --pressure 906.2316708361457,1812.4633416722913,5437.390025016874)

  # The run of doc/files.md.
  add_test(NAME program_surface_manual COMMAND fuge_program --surface examples/data/ground.sdf --scale 1e3 --fill
    --pressure 50,100,200 --young 210000 --poisson 0.3 --field "${folder}/ground.vti"
    WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}")
  set_tests_properties(program_surface_manual PROPERTIES PASS_REGULAR_EXPRESSION
    "40 x 30 heights, 9 of them filled\n.*\n[^\n]*,16, 8\\.0000[^\n]*, 1\\.33333[^\n]*\n[^\n]*,24, [^\n]*\n[^\n]*,37, ")

  # Bounds of the approach, the pressure and the gaps are columns, and all 121 x 121 states are proved.
  add_test(NAME program_surface_proof COMMAND fuge_program --surface ball.txt ${free} --level none --prove)
  set_tests_properties(program_surface_proof PROPERTIES PASS_REGULAR_EXPRESSION
    "residual,status,approach_bound,pressure_bound,gap_bound,proved\n[^\n]*,0, [0-9.]+E-01[0-9], [0-9.]+E-00[0-9], [0-9.]+E-01[0-9],14641\n"
    FIXTURES_REQUIRED program_surfaces WORKING_DIRECTORY "${folder}")

  # A grid that is too small, and heights in another unit than the spacings.
  add_test(NAME program_surface_rim COMMAND fuge_program --surface ball.txt --boundary free --load 1e4 --modulus 115385)
  set_tests_properties(program_surface_rim PROPERTIES PASS_REGULAR_EXPRESSION "# note: [^\n]*rim"
    FIXTURES_REQUIRED program_surfaces WORKING_DIRECTORY "${folder}")
  add_test(NAME program_surface_steep COMMAND fuge_program --surface columns.txt ${free})
  set_tests_properties(program_surface_steep PROPERTIES PASS_REGULAR_EXPRESSION
    "# note: the mean slope [^\n]*--height-scale"
    FIXTURES_REQUIRED program_surfaces WORKING_DIRECTORY "${folder}")
  # Its load rounds to zero, and no cell touches.
  add_test(NAME program_surface_no_load COMMAND fuge_program --surface plain.txt --boundary free --modulus 1
    --spacing 1e-10 --pressure 1e-310)
  set_tests_properties(program_surface_no_load PROPERTIES PASS_REGULAR_EXPRESSION ", 0\\.0000[0-9E+]*, [^,]*,[^,]*,0"
    FIXTURES_REQUIRED program_surfaces WORKING_DIRECTORY "${folder}")
else()
  surface_refuses(without_fftw "FFTW" --surface ball.txt ${free})
endif()

surface_refuses(no_file "\"no_such.sdf\" cannot be opened" --surface no_such.sdf ${free})
surface_refuses(cut "\"cut.txt\", line 2: 3 value\\(s\\), but the first row has 4" --surface cut.txt --spacing 1 ${free})
surface_refuses(hole "\"holes.txt\", line 3: column 1 has no height.*: let such points be filled by --fill"
  --surface holes.txt ${free})
surface_refuses(no_spacing "\"plain.txt\" does not say how far apart its points are: give --spacing"
  --surface plain.txt ${free})
surface_refuses(spacing "--spacing: \"ball.txt\" has spacings of its own, 3.50000E-003 and" --surface ball.txt --spacing 1
  ${free})
surface_refuses(spacings "--spacing 1,2,3: one or two lengths" --surface plain.txt --spacing 1,2,3 ${free})
surface_refuses(scale "--scale 0: it has to be > 0" --surface ball.txt --scale 0 ${free})
surface_refuses(scales "--scale 1,2: one number is needed" --surface ball.txt --scale 1,2 ${free})
surface_refuses(out_of_range "its heights or spacings are out of range after --height-scale" --surface ball.txt
  --height-scale 1e300 ${free})
surface_refuses(too_fine "its heights or spacings are out of range" --surface plain.txt --spacing 1e-160 ${free})
surface_refuses(no_load "with --surface one of --pressure and --load is needed" --surface ball.txt --modulus 1)
surface_refuses(two_loads "with --surface one of --pressure and --load is needed" --surface ball.txt ${free} --pressure 1)
surface_refuses(load "--load 100,: numbers with commas between them are needed, not \"100,\"" --surface ball.txt
  --modulus 1 --load 100,)
surface_refuses(pull "--pressure 5,-1: it has to be > 0" --surface ball.txt --modulus 1 --pressure 5,-1)
surface_refuses(pressure_twice "--pressure is given twice" --surface ball.txt --modulus 1 --pressure 5 --pressure 6)
surface_refuses(no_modulus "with --surface either --modulus, or --young and --poisson" --surface ball.txt --load 1)
surface_refuses(moduli "with --surface either --modulus, or --young and --poisson" --surface ball.txt ${free} --young 1)
surface_refuses(poisson "--young and --poisson go together" --surface ball.txt --load 1 --young 1)
surface_refuses(bodies "--young and --poisson need one number each, or two each" --surface ball.txt --load 1 --young 1,2
  --poisson 0.3)
surface_refuses(incompressible "poisson = 0.6" --surface ball.txt --load 1 --young 1 --poisson 0.6)
surface_refuses(boundary "--boundary open: one of periodic, free, periodic-x, periodic-y is needed" --surface ball.txt
  --load 1 --modulus 1 --boundary open)
surface_refuses(field "--field a.vtu: a surface is a grid, for ParaView a file \\*.vti" --surface ball.txt ${free}
  --field a.vtu)
surface_refuses(overwritten "--output ./ball.txt: the same file as of --surface" --surface ball.txt ${free}
  --output ./ball.txt)
surface_refuses(alpha "one of --alpha, --stiffness and --surface is needed" --surface ball.txt --alpha a.mtx ${free})
surface_refuses(gap "--gap needs matrices or meshes" --surface ball.txt ${free} --gap gap.mtx)
surface_refuses(floats "--floats needs --stiffness" --surface ball.txt ${free} --floats)
program_refuses(level_alone MESSAGE "--level needs --surface" ARGUMENTS ${two_nodes} --load 2 --level none)
program_refuses(pressure_alone MESSAGE "--pressure needs --mesh and --pair, or --surface" ARGUMENTS
  ${two_nodes} --load 2 --pressure 1)
