# names.cmake has to find each of these errors: cmake -D ROOT=.. -D SCRATCH=.. -P names_errors.cmake
cmake_minimum_required(VERSION 3.20)

# With `old` replaced by `new` in the page, the script must fail and say `expected`.
function(expect_error old new expected)
  file(REMOVE_RECURSE "${SCRATCH}")
  file(COPY "${ROOT}/src" DESTINATION "${SCRATCH}")
  file(READ "${ROOT}/doc/architecture.md" page)
  string(REPLACE "${old}" "${new}" changed "${page}")
  if(changed STREQUAL page)
    message(SEND_ERROR "the page does not contain \"${old}\"")
  endif()
  file(WRITE "${SCRATCH}/doc/architecture.md" "${changed}")
  execute_process(COMMAND "${CMAKE_COMMAND}" -DROOT=${SCRATCH} -P "${CMAKE_CURRENT_LIST_DIR}/names.cmake"
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  # Messages are broken into lines.
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  if(status EQUAL 0 OR NOT output MATCHES "${expected} ")
    message(SEND_ERROR "\"${old}\" changed to \"${new}\" was not found:\n${output}")
  endif()
endfunction()

expect_error("`find_violation`" "`find_violations`" "find_violations is not in src/")
expect_error("`fuge_equilibrium`" "`fuge_balance`" "fuge_balance is not in src/")
expect_error("`coarsen`" "`operator%coarsen`" "operator%coarsen is not a name")
expect_error("\n    solver/  " "\n    solvers/  " "the tree lacks solver/ the tree has solvers/, which src/folders.txt lacks")
