# components.cmake has to find each of these offences: cmake -D SOURCES=src -D SCRATCH=.. -P components_offences.cmake
cmake_minimum_required(VERSION 3.20)

include("${CMAKE_CURRENT_LIST_DIR}/planting.cmake")
file(COPY "${SOURCES}/" DESTINATION "${SCRATCH}")

# An engine that sees the half-plane, and the certificate's folder that sees an engine.
plant(core/dense/common/fuge_planted_one.f90
  "module fuge_planted_one\n  use fuge_halfplane_fft, only: a\nend module fuge_planted_one\n"
  "core/dense/common/fuge_planted_one.f90 uses fuge_halfplane_fft: core/dense/common may not use \
bodies/halfplane/grid\n")
plant(core/problem/fuge_planted_two.f90
  "module fuge_planted_two\n  use, non_intrinsic :: fuge_equilibrium\nend module fuge_planted_two\n"
  "core/problem/fuge_planted_two.f90 uses fuge_equilibrium: core/problem may not use core/dense/common\n")
# A room of another one, and a folder around it.
plant(core/products/scene/fuge_planted_three.f90
  "module fuge_planted_three\n  use fuge_iterative_engine, only: a\nend module fuge_planted_three\n"
  "core/products/scene may not use core/products\n")
# The core that sees another component, in a module, in its table, and in the table of all components.
plant(core/problem/fuge_planted_four.f90
  "module fuge_planted_four\n  use fuge_halfspace_fft, only: a\nend module fuge_planted_four\n"
  "core/problem/fuge_planted_four.f90 uses fuge_halfspace_fft: core/problem may not use bodies/halfspace/grid\n")
plant(bodies/halfplane/folders.txt "grid : layers/stack\n"
  "bodies/halfplane/folders.txt has bodies/halfplane/grid twice\n"
  "bodies/halfplane/folders.txt lets bodies/halfplane/grid use bodies/layers/stack: halfplane may not use layers\n")
# A body that knows an engine, in its table and in a module.
plant(bodies/rings/folders.txt "field : core/products\n"
  "bodies/rings/folders.txt lets bodies/rings/field use core/products: a body knows no engine\n")
plant(bodies/layers/stack/fuge_planted_six.f90
  "module fuge_planted_six\n  use fuge_active_set_engine, only: a\nend module fuge_planted_six\n"
  "bodies/layers/stack/fuge_planted_six.f90 uses fuge_active_set_engine: bodies/layers/stack may not use \
core/dense/active_set\n")
plant(components.txt "core : files\n" "components.txt has core twice\n")
plant(components.txt "early : late\nlate :\n" "components.txt lets early use late, which is not above it\n")
plant(components.txt "district :\n" "components.txt names district, which is not a folder\n")
plant(quarter/fuge_planted_five.f90 "module fuge_planted_five\nend module fuge_planted_five\n"
  "quarter belongs to no component of components.txt\n")
# After a semicolon nothing is lost, and the facades are for callers.
plant(core/base/fuge_planted_seven.f90
  "module fuge_planted_seven\n  implicit none; private\n  use fuge_core\nend module fuge_planted_seven\n"
  "core/base/fuge_planted_seven.f90 uses fuge_core: core/base may not use core\n")
plant(core/base/fuge_planted_eight.f90
  "module fuge_planted_eight\n  use fuge_of_nowhere\nend module fuge_planted_eight\n"
  "core/base/fuge_planted_eight.f90 uses fuge_of_nowhere, which is no module of fuge\n")
plant(core/base/fuge_planted_nine.f90 "module fuge_other\nend module fuge_other\n"
  "core/base/fuge_planted_nine.f90 holds module fuge_other\n")
plant(core/base/fuge_planted_fifteen.f90 "submodule(fuge_solver_type) fuge_other\nend submodule fuge_other\n"
  "core/base/fuge_planted_fifteen.f90 holds submodule fuge_other\n"
  "core/base/fuge_planted_fifteen.f90 is a part of fuge_solver_type, which is in another folder\n")
plant(core/room/fuge_planted_ten.f90 "module fuge_planted_ten\nend module fuge_planted_ten\n"
  "core/folders.txt lacks the folder core/room\n")
plant(fe/tableau/fuge_planted_sixteen.f90 "module fuge_planted_sixteen\nend module fuge_planted_sixteen\n"
  "fe/tableau has the name of another folder\n")
plant(core/folders.txt "cellar : base\n" "core/folders.txt names core/cellar, a folder without sources\n")
plant(bodies/rings/folders.txt "hertz : core/attic\n"
  "bodies/rings/folders.txt lets bodies/rings/hertz use core/attic, which is not a folder\n")
# Circles: of two folders, and of a folder with one that holds a folder below it.
plant_instead(core/folders.txt "base :" "base : problem"
  "core/folders.txt lets core/base use core/problem, which is not above it\n")
plant_instead(core/folders.txt "dense/common : base algebra problem" "dense/common : base algebra problem dense"
  "core/folders.txt lets core/dense/common use core/dense/tableau, which is not above it\n")
# Arguments and chains.
plant(core/base/fuge_planted_eleven.f90
  "module fuge_planted_eleven\ncontains\n  !> A sum.\n  subroutine add(a, b, c, &\n    d, e, f, g, h, \
i)\n  end subroutine add\nend module fuge_planted_eleven\n"
  "core/base/fuge_planted_eleven.f90: add has 9 arguments, and its docstring does not say why\n")
plant(core/base/fuge_planted_twelve.f90
  "module fuge_planted_twelve\ncontains\n  subroutine add(scene)\n    \
call scene%rows%all%space%agree(info)\n  end subroutine add\nend module fuge_planted_twelve\n"
  "core/base/fuge_planted_twelve.f90 reaches through to the space of points: scene%rows%all%space%\n")
# One file too many.
file(GLOB files "${SOURCES}/core/base/*.*")
list(LENGTH files count)
if(NOT count EQUAL 15)
  message(SEND_ERROR "core/base has ${count} files: plant the next one in a folder that has 15")
endif()
plant(core/base/fuge_planted_thirteen.f90 "module fuge_planted_thirteen\nend module fuge_planted_thirteen\n"
  "core/base has [0-9]+ files, more than 15\n")

expect_offences(components.cmake -DSOURCES=${SCRATCH})
