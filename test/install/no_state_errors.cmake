# no_state.cmake has to find each of these variables.
cmake_minimum_required(VERSION 3.20)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

# Look at a module with these lines in a function of i; the script must fail and name `expected`, or pass
# if that is empty.
function(expect_finding result lines expected)
  file(REMOVE_RECURSE "${SCRATCH}")
  file(MAKE_DIRECTORY "${SCRATCH}")
  file(WRITE "${SCRATCH}/fuge_state.f90" "module fuge_state\ncontains\nfunction f(i) result(s)\ninteger, intent(in) :: i
    ${result} :: s\n${lines}\nend function f\nsubroutine g(i)\ninteger, intent(in) :: i\ncall h('i = '//f(i)//'.')
    end subroutine g\nsubroutine h(s)\ncharacter(len=*), intent(in) :: s\nprint *, s\nend subroutine h\nend module\n")
  run("compile" "${CMAKE_COMMAND}" -E chdir "${SCRATCH}" "${Fortran_COMPILER}" -c fuge_state.f90 -o state.o)
  execute_process(COMMAND "${CMAKE_COMMAND}" -DNM=${NM} -DARCHIVE=${SCRATCH}/state.o
      -P "${CMAKE_CURRENT_LIST_DIR}/no_state.cmake"
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  # Messages are broken into lines.
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  if(expected STREQUAL "" AND NOT status EQUAL 0)
    message(SEND_ERROR "refused without a reason:\n${output}")
  elseif(NOT expected STREQUAL "" AND (status EQUAL 0 OR NOT output MATCHES "${expected}"))
    message(SEND_ERROR "not found: ${expected}\n${output}")
  endif()
endfunction()

set(known "character(len=i)")
expect_finding("${known}" "s = 'x'" "")
expect_finding("${known}" "integer :: calls = 0\ncalls = calls + 1\ns = char(calls)" "share these variables: calls")
expect_finding("${known}" "integer, save :: calls\ncalls = i\ns = char(calls)" "share these variables: calls")
expect_finding("character(len=:), allocatable" "s = repeat('x', i)" "share these variables: slen")
