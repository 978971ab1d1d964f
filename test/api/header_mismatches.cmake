# header_matches.cmake has to find each of these changes of the headers.
# cmake -DINCLUDE_DIR=include -DMPI_HEADER=fuge_mpi.h -DSOURCES=src -DSCRATCH=.. -P header_mismatches.cmake
cmake_minimum_required(VERSION 3.20)

# Replace `old` by `new` in a copy of the header `name`; the script must fail and say `expected`.
function(expect_mismatch name old new expected)
  file(REMOVE_RECURSE "${SCRATCH}")
  file(COPY "${INCLUDE_DIR}/" DESTINATION "${SCRATCH}/include")
  file(COPY "${MPI_HEADER}" DESTINATION "${SCRATCH}/mpi")
  file(GLOB file "${SCRATCH}/*/${name}")
  file(READ "${file}" text)
  string(REPLACE "${old}" "${new}" changed "${text}")
  if(changed STREQUAL text)
    message(SEND_ERROR "${name} does not contain \"${old}\"")
  endif()
  file(WRITE "${file}" "${changed}")
  expect_failure("${expected}")
endfunction()

function(expect_failure expected)
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -DINCLUDE_DIR=${SCRATCH}/include -DMPI_HEADER=${SCRATCH}/mpi/fuge_mpi.h
      -DSOURCES=${SOURCES} -P "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/header_matches.cmake"
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  # Messages are broken into lines.
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  if(status EQUAL 0 OR NOT output MATCHES "${expected}")
    message(SEND_ERROR "not found: ${expected}\n${output}")
  endif()
endfunction()

expect_mismatch(fuge_core.h "FUGE_ERR_WIDTH = -4" "FUGE_ERR_WIDTH = -5" "in fuge_core.h: FUGE_ERR_WIDTH = -5")
expect_mismatch(fuge_core.h "FUGE_ERR_GRID = -7," "" "in its sources: FUGE_ERR_GRID = -7")
expect_mismatch(fuge_core.h "FUGE_DONE = 0," "FUGE_DONE = 0, FUGE_NEW = 77," "in fuge_core.h: FUGE_NEW = 77")
expect_mismatch(fuge_core.h "int fuge_reset(" "int fuge_restart(" "in fuge_core.h: fuge_restart")
expect_mismatch(fuge_core.h "int fuge_reset(fuge_solver *s);" "" "in its sources: fuge_reset")
expect_mismatch(fuge_core.h "FUGE_VERSION \"" "FUGE_VERSION \"9." "the headers have #define FUGE_VERSION \"9\\.")
expect_mismatch(fuge_mpi.h "int fuge_operator_rows(" "int fuge_operator_lines(" "in fuge_mpi.h: fuge_operator_lines")
expect_mismatch(fuge_punches.h "  double reserved[8];\n} fuge_punch_report;" "} fuge_punch_report;"
  "fuge_punches.h: a struct without reserved members: struct fuge_punch_report")

# In the header of another component: a function and a constant that there are.
expect_mismatch(fuge_files.h "int fuge_write_mesh(" "int fuge_field_largest(void);\nint fuge_write_mesh("
  "functions only in fuge_files.h: fuge_field_largest functions only")
expect_mismatch(fuge_punches.h "typedef struct fuge_punch fuge_punch;" "enum { FUGE_CENTRE = 0 };"
  "constants only in fuge_punches.h: FUGE_CENTRE = 0")
expect_mismatch(fuge.h "#endif" "int fuge_reset(fuge_solver *s);\n#endif" "fuge.h declares fuge_reset")

# Headers include what their components may use, fuge.h all of them.
expect_mismatch(fuge_punches.h "#include \"fuge_elastic.h\"" "#include \"fuge_fe.h\""
  "fuge_punches.h includes fuge_fe.h: punches may not use it")
expect_mismatch(fuge.h "#include \"fuge_punches.h\"" ""
  "fuge.h includes fuge_accuracy.h;fuge_core.h;fuge_elastic.h;fuge_fe.h;fuge_files.h;fuge_halfplane.h;\
fuge_halfspace.h;fuge_layers.h;fuge_rings.h")
file(WRITE "${SCRATCH}/include/fuge_walls.h" "\n")
expect_failure("no component has the header fuge_walls.h")
