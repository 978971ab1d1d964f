# Tests and module fuge: cmake -D ROOT=. -P facade.cmake
#
# Module fuge has all public names, and reading it costs a compiler more than all else in a test. So tests use the
# modules that define what they need; but test/unit/topics/test_facade.pf, which is the test of fuge, and the programs
# of test/install, which see only what is installed.
cmake_minimum_required(VERSION 3.20)

get_filename_component(ROOT "${ROOT}" REALPATH)
set(offences)
file(GLOB_RECURSE files RELATIVE "${ROOT}" "${ROOT}/test/*.pf" "${ROOT}/test/*.f90" "${ROOT}/test/*.F90")
list(FILTER files EXCLUDE REGEX "^test/install/")
if(NOT test/unit/topics/test_facade.pf IN_LIST files)
  message(FATAL_ERROR "test/unit/topics/test_facade.pf is not in ${ROOT}: is it the right folder?")
endif()
list(REMOVE_ITEM files test/unit/topics/test_facade.pf)
foreach(file IN LISTS files)
  file(STRINGS "${ROOT}/${file}" lines REGEX "^ *use *(::)? *fuge *(,|!|$)")
  if(lines)
    list(APPEND offences "${file} uses fuge")
  endif()
endforeach()

if(offences)
  list(JOIN offences "\n  " offences)
  message(FATAL_ERROR "Name the modules that define what is used instead (src/<component>/fuge_<component>.f90 says "
    "which):\n  ${offences}")
endif()
list(LENGTH files count)
message(STATUS "${count} files of tests name the modules that they use")
