# symbols.cmake has to find a name too many and a function that is missing.
cmake_minimum_required(VERSION 3.20)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

file(REMOVE_RECURSE "${SCRATCH}")
file(MAKE_DIRECTORY "${SCRATCH}/include")
file(WRITE "${SCRATCH}/include/fuge.h" "int fuge_one(void);\nint fuge_two(int n);\n")

# Look at a library made of `source`; the script must fail and name `expected`, or pass if that is empty.
function(expect_finding source expected)
  file(WRITE "${SCRATCH}/library.c" "${source}")
  run("compile" "${C_COMPILER}" -shared -fPIC "${SCRATCH}/library.c" -o "${SCRATCH}/library.so")
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -DNM=${NM} -DLIBRARY=${SCRATCH}/library.so "-DSYMBOLS=${SYMBOLS}"
      -DINCLUDE_DIR=${SCRATCH}/include -P "${CMAKE_CURRENT_LIST_DIR}/symbols.cmake"
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  # Messages are broken into lines.
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  if(expected STREQUAL "" AND NOT status EQUAL 0)
    message(SEND_ERROR "refused without a reason:\n${output}")
  elseif(NOT expected STREQUAL "" AND (status EQUAL 0 OR NOT output MATCHES "${expected}"))
    message(SEND_ERROR "not found: ${expected}\n${output}")
  endif()
endfunction()

set(both "int fuge_one(void) { return 1; }\nint fuge_two(int n) { return n; }\n")
expect_finding("${both}" "")
expect_finding("${both}int solve(void) { return 2; }\n" "not its own: solve")
expect_finding("${both}int the_fuge_counter;\n" "not its own: the_fuge_counter")
expect_finding("${both}int fuge_three(void) { return 3; }\n" "no header has: fuge_three")
expect_finding("int fuge_one(void) { return 1; }\n" "does not show: fuge_two")
