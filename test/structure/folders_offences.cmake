# folders.cmake has to find each of these offences: cmake -D SOURCES=src -D SCRATCH=.. -P folders_offences.cmake
cmake_minimum_required(VERSION 3.20)

# With `text` as a new file, the script must fail and say `expected`.
function(expect_offence file text expected)
  file(REMOVE_RECURSE "${SCRATCH}")
  file(COPY "${SOURCES}/" DESTINATION "${SCRATCH}")
  if(file STREQUAL "folders.txt")
    file(APPEND "${SCRATCH}/${file}" "${text}")
  else()
    file(WRITE "${SCRATCH}/${file}" "${text}")
  endif()
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -DSOURCES=${SCRATCH} -P "${CMAKE_CURRENT_LIST_DIR}/folders.cmake"
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(status EQUAL 0 OR NOT output MATCHES "${expected}")
    message(SEND_ERROR "${file} was not found to say \"${expected}\":\n${output}")
  endif()
endfunction()

# An engine that sees the half-plane, and the certificate's folder that sees an engine.
expect_offence(engines/common/fuge_planted.f90
  "module fuge_planted\n  use fuge_halfplane_fft, only: a\nend module fuge_planted\n"
  "engines/common/fuge_planted.f90 uses fuge_halfplane_fft: engines/common may not use halfplane\n")
expect_offence(model/fuge_planted.f90
  "module fuge_planted\n  use, non_intrinsic :: fuge_equilibrium\nend module fuge_planted\n"
  "model/fuge_planted.f90 uses fuge_equilibrium: model may not use engines/common\n")
# After a semicolon nothing is lost, and the facade is for callers.
expect_offence(base/fuge_planted.f90
  "module fuge_planted\n  implicit none; private\n  use fuge\nend module fuge_planted\n"
  "base/fuge_planted.f90 uses fuge: base may not use \\.\n")
expect_offence(base/fuge_planted.f90
  "module fuge_planted\n  use fuge_of_nowhere\nend module fuge_planted\n"
  "base/fuge_planted.f90 uses fuge_of_nowhere, which is no module of fuge\n")
expect_offence(base/fuge_planted.f90 "module fuge_other\nend module fuge_other\n"
  "base/fuge_planted.f90 holds module fuge_other\n")
expect_offence(new_room/fuge_planted.f90 "module fuge_planted\nend module fuge_planted\n"
  "new_room/fuge_planted.f90 is in a folder that folders.txt does not have\n")
expect_offence(folders.txt "new_room : base\n" "folders.txt names new_room, which is not a folder\n")
expect_offence(folders.txt "io : base new_room\n" "folders.txt lets io use new_room, which has no entry\n")
