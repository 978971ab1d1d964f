# header_matches.cmake has to find each of these changes of the header.
cmake_minimum_required(VERSION 3.20)

get_filename_component(folder "${HEADER}" DIRECTORY)
file(COPY "${folder}/" DESTINATION "${SCRATCH}")

# Replace `old` by `new` in a copy of the header; the script must fail and name `expected`.
function(expect_mismatch old new expected)
  file(READ "${HEADER}" text)
  string(REPLACE "${old}" "${new}" changed "${text}")
  if(changed STREQUAL text)
    message(SEND_ERROR "the header does not contain \"${old}\"")
  endif()
  file(WRITE "${SCRATCH}/fuge.h" "${changed}")
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -DHEADER=${SCRATCH}/fuge.h -DSOURCES=${SOURCES}
      -P "${CMAKE_CURRENT_LIST_DIR}/header_matches.cmake"
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(status EQUAL 0 OR NOT output MATCHES "${expected}")
    message(SEND_ERROR "\"${old}\" changed to \"${new}\" was not found:\n${output}")
  endif()
endfunction()

expect_mismatch("FUGE_ERR_WIDTH = -4" "FUGE_ERR_WIDTH = -5" "in the header: FUGE_ERR_WIDTH = -5")
expect_mismatch("FUGE_ERR_GRID = -7," "" "in Fortran: FUGE_ERR_GRID = -7")
expect_mismatch("FUGE_DONE = 0," "FUGE_DONE = 0, FUGE_NEW = 77," "in the header: FUGE_NEW = 77")
expect_mismatch("int fuge_reset(" "int fuge_restart(" "in the header: fuge_restart")
expect_mismatch("int fuge_reset(fuge_solver *s);" "" "in Fortran: fuge_reset")
expect_mismatch("FUGE_VERSION \"" "FUGE_VERSION \"9." "in the header: 9\\.")
