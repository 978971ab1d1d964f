# One version: cmake -D ROOT=. -P versions.cmake
#
# Each file that repeats the version, such as the manifests of fpm, has the one of include/fuge_core.h.
cmake_minimum_required(VERSION 3.20)

file(STRINGS "${ROOT}/include/fuge_core.h" line REGEX "define FUGE_VERSION ")
string(REGEX REPLACE ".*\"(.*)\".*" "\\1" version "${line}")

get_filename_component(ROOT "${ROOT}" REALPATH)
set(offences)
# The first version in each line of `file` that matches `pattern` is the right one, and there is such a line.
function(expect_version file pattern)
  file(STRINGS "${ROOT}/${file}" lines REGEX "${pattern}")
  if(NOT lines)
    list(APPEND offences "${file} gives no version")
  endif()
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "[ \"'/-]([0-9]+[.][0-9.]+)" OR NOT CMAKE_MATCH_1 STREQUAL version)
      list(APPEND offences "${file} has not version ${version}: ${line}")
    endif()
  endforeach()
  set(offences ${offences} PARENT_SCOPE)
endfunction()

file(GLOB manifests RELATIVE "${ROOT}" "${ROOT}/fpm.toml" "${ROOT}/src/*/fpm.toml"
  "${ROOT}/src/bodies/*/fpm.toml")
foreach(manifest IN LISTS manifests)
  expect_version("${manifest}" "^version = ")
endforeach()
expect_version(src/core/fuge_version_number.f90 " FUGE_VERSION = ")
expect_version(CITATION.cff "^version: ")
expect_version(doc/man/fuge.3 "^[.]TH ")
expect_version(doc/install.md "fuge-[0-9.]+-py3")

if(offences)
  list(JOIN offences "\n  " offences)
  message(FATAL_ERROR "These differ from include/fuge_core.h:\n  ${offences}")
endif()
list(LENGTH manifests count)
message(STATUS "${count} manifests of fpm and all others have version ${version}")
