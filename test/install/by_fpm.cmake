# fpm projects in Fortran and C: one links the copy in PREFIX; the other one, without PREFIX, depends on the
# sources in SOURCE_DIR.
# ctest sets PREFIX and PKG_CONFIG or SOURCE_DIR; LIBDIR, KIND, SCRATCH, FPM and Fortran_COMPILER.
cmake_minimum_required(VERSION 3.20)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

set(flags)
set(project fpm_source)
if(PREFIX)
  ask_pkg_config(compile "${PREFIX}" --cflags fuge)
  ask_pkg_config(link "${PREFIX}" --libs-only-L fuge)
  set(flags --flag "${compile}" --c-flag "${compile}" --link-flag "${link}")
  set(project fpm)
endif()
file(REMOVE_RECURSE "${SCRATCH}")
file(COPY "${CMAKE_CURRENT_LIST_DIR}/${project}/" DESTINATION "${SCRATCH}")
if(NOT PREFIX)
  # fpm takes no absolute path.
  file(RELATIVE_PATH SOURCE_DIR "${SCRATCH}" "${SOURCE_DIR}")
  configure_file("${CMAKE_CURRENT_LIST_DIR}/${project}/fpm.toml" "${SCRATCH}/fpm.toml" @ONLY)
endif()
configure_file("${CMAKE_CURRENT_LIST_DIR}/fortran/main.f90" "${SCRATCH}/app/main.f90" COPYONLY)
configure_file("${CMAKE_CURRENT_LIST_DIR}/c/main.c" "${SCRATCH}/app/main.c" COPYONLY)
foreach(target IN ITEMS fortran c)
  expect_answer_in("${PREFIX}" "${target} by fpm, ${KIND}" "${CMAKE_COMMAND}" -E chdir "${SCRATCH}"
    "${FPM}" run --compiler "${Fortran_COMPILER}" --target ${target} ${flags})
endforeach()
