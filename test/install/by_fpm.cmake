# fpm projects in Fortran and C: one links the copy in PREFIX; the other one, without PREFIX, depends on the
# sources in SOURCE_DIR.
# ctest sets PREFIX and PKG_CONFIG, or SOURCE_DIR, MAKE_PROGRAM and BUILT; LIBDIR, KIND, SCRATCH, FPM and
# Fortran_COMPILER.
cmake_minimum_required(VERSION 3.20)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

set(options)
set(project fpm_source)
if(PREFIX)
  ask_pkg_config(compile "${PREFIX}" --cflags fuge)
  ask_pkg_config(link "${PREFIX}" --libs-only-L fuge)
  set(options --flag "${compile}" --c-flag "${compile}" --link-flag "${link}")
  set(project fpm)
endif()
file(REMOVE_RECURSE "${SCRATCH}")
file(COPY "${CMAKE_CURRENT_LIST_DIR}/${project}/" DESTINATION "${SCRATCH}")
if(NOT PREFIX)
  set(flags -O0)
  prepare_compiling()
  set(options --flag "${flags}" --c-flag -O0)
  if(BUILT)
    # What is compiled anew is not optimised.
    list(APPEND compiling FURTHER=-O0)
    # fpm knows a compiler by its name.
    file(CONFIGURE OUTPUT "${SCRATCH}/gfortran" @ONLY
      CONTENT "#!/bin/sh\nexec '@CMAKE_CURRENT_LIST_DIR@/take_built.sh' '@Fortran_COMPILER@' \"$@\"\n")
    file(CHMOD "${SCRATCH}/gfortran" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
    set(Fortran_COMPILER "${SCRATCH}/gfortran")
  endif()
  # fpm takes no absolute path.
  set(sources "${SOURCE_DIR}")
  file(RELATIVE_PATH SOURCE_DIR "${SCRATCH}" "${sources}")
  configure_file("${CMAKE_CURRENT_LIST_DIR}/${project}/fpm.toml" "${SCRATCH}/fpm.toml" @ONLY)
endif()
configure_file("${CMAKE_CURRENT_LIST_DIR}/fortran/main.f90" "${SCRATCH}/app/main.f90" COPYONLY)
configure_file("${CMAKE_CURRENT_LIST_DIR}/c/main.c" "${SCRATCH}/app/main.c" COPYONLY)
# Both programs at once: for each target alone fpm would compile the library again.
expect_answer_in("${PREFIX}" "Fortran and C by fpm, ${KIND}" ${compiling} "${CMAKE_COMMAND}" -E chdir "${SCRATCH}"
  "${FPM}" run --compiler "${Fortran_COMPILER}" --all ${options})
string(REGEX MATCHALL "${answer}" answers "${output}")
list(LENGTH answers count)
if(NOT count EQUAL 2)
  message(FATAL_ERROR "${count} programs by fpm have answered, not 2: ${output}")
endif()
