# docstrings.cmake has to find each of these docstrings when it is gone.
cmake_minimum_required(VERSION 3.20)

# Without the docstring before the line with `declaration`, the script must fail and name `expected`.
function(expect_missing file declaration expected)
  file(REMOVE_RECURSE "${SCRATCH}")
  file(COPY "${ROOT}/src" DESTINATION "${SCRATCH}")
  file(READ "${ROOT}/${file}" text)
  string(REGEX REPLACE "(\n *!>[^\n]*)+(\n[^!\n]*${declaration})" "\\2" changed "${text}")
  if(changed STREQUAL text)
    message(SEND_ERROR "${file} has no docstring before \"${declaration}\"")
  endif()
  file(WRITE "${SCRATCH}/${file}" "${changed}")
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -DROOT=${SCRATCH} -P "${CMAKE_CURRENT_LIST_DIR}/docstrings.cmake"
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(status EQUAL 0 OR NOT output MATCHES "${file}: ${expected}\n")
    message(SEND_ERROR "The docstring of \"${declaration}\" is gone, which was not found:\n${output}")
  endif()
endfunction()

expect_missing(src/core/base/fuge_status.f90 ":: FUGE_ERR_MEMORY" "FUGE_ERR_MEMORY")
expect_missing(src/core/problem/fuge_problem_type.f90 "type, public :: fuge_solution" "fuge_solution")
expect_missing(src/core/problem/fuge_options_type.f90 ":: keep_history" "fuge_options%keep_history")
expect_missing(src/core/base/fuge_status.f90 "function failed" "fuge_info%failed")
expect_missing(src/core/problem/fuge_monitor_type.f90 "subroutine report_progress" "fuge_monitor%progress")
expect_missing(src/bodies/elastic/field/fuge_field_type.f90 "procedure.find_peak., deferred :: find_largest"
  "fuge_field%find_largest")
expect_missing(src/sparse/fuge_sparse.f90 "type, extends.fuge_stiffness., public :: fuge_sparse_stiffness"
  "fuge_sparse_stiffness")
