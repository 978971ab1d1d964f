# names.cmake has to find each of these errors: cmake -D ROOT=.. -D SCRATCH=.. -P names_errors.cmake
cmake_minimum_required(VERSION 3.20)

file(REMOVE_RECURSE "${SCRATCH}")
file(COPY "${ROOT}/src" DESTINATION "${SCRATCH}")
file(READ "${ROOT}/doc/architecture.md" page)
set(all_expected)

# With `old` replaced by `new` in the page, the script must say `expected`.
macro(plant old new expected)
  string(REPLACE "${old}" "${new}" changed "${page}")
  if(changed STREQUAL page)
    message(SEND_ERROR "the page does not contain \"${old}\"")
  endif()
  set(page "${changed}")
  list(APPEND all_expected "${expected}")
endmacro()

plant("`find_violation`" "`find_violations`" "find_violations is not in src/")
plant("`fuge_kkt_factor`" "`fuge_balance`" "fuge_balance is not in src/")
plant("`certify`" "`solver%certify`" "solver%certify is not a name")
plant("\n    core/solver/  " "\n    core/solvers/  "
  "the tree lacks core/solver/ the tree has core/solvers/, which folders.txt lacks")
file(WRITE "${SCRATCH}/doc/architecture.md" "${page}")
execute_process(COMMAND "${CMAKE_COMMAND}" -DROOT=${SCRATCH} -P "${CMAKE_CURRENT_LIST_DIR}/names.cmake"
  RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
# Messages are broken into lines.
string(REGEX REPLACE "[ \n]+" " " output "${output}")
foreach(expected IN LISTS all_expected)
  if(status EQUAL 0 OR NOT output MATCHES "${expected} ")
    message(SEND_ERROR "not found: ${expected}\n${output}")
  endif()
endforeach()
