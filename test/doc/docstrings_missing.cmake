# docstrings.cmake has to find each of these docstrings when it is gone.
cmake_minimum_required(VERSION 3.20)

# Without the lines that match, the script must fail and name `expected`.
function(expect_missing file lines expected)
  file(REMOVE_RECURSE "${SCRATCH}")
  file(COPY "${ROOT}/src" "${ROOT}/sparse" DESTINATION "${SCRATCH}")
  file(READ "${ROOT}/${file}" text)
  string(REGEX REPLACE "\n *!> ${lines}[^\n]*" "" changed "${text}")
  if(changed STREQUAL text)
    message(SEND_ERROR "${file} does not contain \"${lines}\"")
  endif()
  file(WRITE "${SCRATCH}/${file}" "${changed}")
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -DROOT=${SCRATCH} -P "${CMAKE_CURRENT_LIST_DIR}/docstrings.cmake"
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(status EQUAL 0 OR NOT output MATCHES "${file}: ${expected}\n")
    message(SEND_ERROR "\"${lines}\" is gone, which was not found:\n${output}")
  endif()
endfunction()

expect_missing(src/base/fuge_status.f90 "An allocation failed" "FUGE_ERR_MEMORY")
expect_missing(src/model/fuge_problem_type.f90 "The answer, in the same units" "fuge_solution")
expect_missing(src/model/fuge_options_type.f90 "Keep basis and z" "fuge_options%keep_history")
expect_missing(src/base/fuge_status.f90 "True for an error" "fuge_info%failed")
expect_missing(src/model/fuge_monitor_type.f90 "" "fuge_monitor%progress")
expect_missing(sparse/fuge_sparse.f90 "A sparse stiffness matrix" "fuge_sparse_stiffness")
