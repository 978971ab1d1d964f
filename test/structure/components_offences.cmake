# components.cmake has to find each of these offences: cmake -D SOURCES=src -D SCRATCH=.. -P components_offences.cmake
cmake_minimum_required(VERSION 3.20)

# With `text` in a new file, or at the end of a table, the script must fail and say `expected`.
function(expect_offence file text expected)
  file(REMOVE_RECURSE "${SCRATCH}")
  file(COPY "${SOURCES}/" DESTINATION "${SCRATCH}")
  if(file MATCHES "[.]txt$")
    file(APPEND "${SCRATCH}/${file}" "${text}")
  else()
    file(WRITE "${SCRATCH}/${file}" "${text}")
  endif()
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -DSOURCES=${SCRATCH} -P "${CMAKE_CURRENT_LIST_DIR}/components.cmake"
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(status EQUAL 0 OR NOT output MATCHES "${expected}")
    message(SEND_ERROR "${file} was not found to say \"${expected}\":\n${output}")
  endif()
endfunction()

# An engine that sees the half-plane, and the certificate's folder that sees an engine.
expect_offence(core/engines/common/fuge_planted.f90
  "module fuge_planted\n  use fuge_halfplane_fft, only: a\nend module fuge_planted\n"
  "core/engines/common/fuge_planted.f90 uses fuge_halfplane_fft: core/engines/common may not use core/halfplane\n")
expect_offence(core/model/fuge_planted.f90
  "module fuge_planted\n  use, non_intrinsic :: fuge_equilibrium\nend module fuge_planted\n"
  "core/model/fuge_planted.f90 uses fuge_equilibrium: core/model may not use core/engines/common\n")
# A room of another one, and a folder around it.
expect_offence(core/engines/iterative/scene/fuge_planted.f90
  "module fuge_planted\n  use fuge_iterative_engine, only: a\nend module fuge_planted\n"
  "core/engines/iterative/scene may not use core/engines/iterative\n")
# The core that sees another component, in a module, in its table, and in the table of all components.
expect_offence(core/model/fuge_planted.f90
  "module fuge_planted\n  use fuge_halfspace_fft, only: a\nend module fuge_planted\n"
  "core/model/fuge_planted.f90 uses fuge_halfspace_fft: core/model may not use area/halfspace\n")
expect_offence(punch/folders.txt "c : area/halfspace\n"
  "punch/folders.txt has c twice.*punch/folders.txt lets c use area/halfspace: punch may not use area\n")
expect_offence(components.txt "core : files\n" "components.txt has core twice\n")
expect_offence(components.txt "early : late\nlate :\n" "components.txt lets early use late, which is not above it\n")
expect_offence(components.txt "district :\n" "components.txt names district, which is not a folder\n")
expect_offence(district/fuge_planted.f90 "module fuge_planted\nend module fuge_planted\n"
  "district belongs to no component of components.txt\n")
# The program uses the public modules only.
expect_offence(program/text/planted.f90
  "module planted\n  use fuge_text_reader, only: a\nend module planted\n"
  "program/text/planted.f90 uses fuge_text_reader: program/text may not use files/text\n")
# After a semicolon nothing is lost, and the facades are for callers.
expect_offence(core/base/fuge_planted.f90
  "module fuge_planted\n  implicit none; private\n  use fuge_core\nend module fuge_planted\n"
  "core/base/fuge_planted.f90 uses fuge_core: core/base may not use core\n")
expect_offence(core/base/fuge_planted.f90
  "module fuge_planted\n  use fuge_of_nowhere\nend module fuge_planted\n"
  "core/base/fuge_planted.f90 uses fuge_of_nowhere, which is no module of fuge\n")
expect_offence(core/base/fuge_planted.f90 "module fuge_other\nend module fuge_other\n"
  "core/base/fuge_planted.f90 holds module fuge_other\n")
expect_offence(core/room/fuge_planted.f90 "module fuge_planted\nend module fuge_planted\n"
  "core/folders.txt lacks the folder core/room\n")
expect_offence(core/folders.txt "room : base\n" "core/folders.txt names room, a folder without sources\n")
expect_offence(area/folders.txt "hertz : core/room\n" "area/folders.txt lets hertz use core/room, which is not a folder\n")
# Arguments and chains.
expect_offence(core/base/fuge_planted.f90
  "module fuge_planted\ncontains\n  !> A sum.\n  subroutine add(a, b, c, &\n    d, e, f, g, h, i)\n  end subroutine add\nend module fuge_planted\n"
  "core/base/fuge_planted.f90: add has 9 arguments, and its docstring does not say why\n")
expect_offence(core/base/fuge_planted.f90
  "module fuge_planted\ncontains\n  subroutine add(scene)\n    call scene%rows%all%space%agree(info)\n  end subroutine add\nend module fuge_planted\n"
  "core/base/fuge_planted.f90 reaches through to the space of points: scene%rows%all%space%\n")
# One file too many.
file(GLOB files "${SOURCES}/core/c/*.f90")
list(LENGTH files count)
if(NOT count EQUAL 15)
  message(SEND_ERROR "core/c has ${count} files: plant the next one in a folder that has 15")
endif()
expect_offence(core/c/fuge_planted.f90 "module fuge_planted\nend module fuge_planted\n"
  "core/c has 16 files, more than 15\n")
