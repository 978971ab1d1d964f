# Installs a build into a scratch prefix, which is not the configured one, and has small
# projects use it: C and Fortran, by find_package and by pkg-config.
# Called by ctest, which sets BUILD_DIR, CONFIG, SCRATCH, LIBDIR, GENERATOR, MAKE_PROGRAM,
# C_COMPILER, FORTRAN_COMPILER and PKG_CONFIG.
cmake_minimum_required(VERSION 3.20)

set(prefix "${SCRATCH}/prefix")
set(answer "force +2\\.000 +0\\.000 +gap +0\\.000 +0\\.800 +approach +0\\.400")

# Run a command; stop the test if it fails.  Its output is in `output`.
function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${what} failed (${status}): ${command}\n${output}\n${errors}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# Run a consumer, with `...` before it, and look at what it prints.
function(expect_answer what program)
  run("${what}: run" ${ARGN} "${program}")
  if(NOT output MATCHES "${answer}")
    message(FATAL_ERROR "${what} printed the wrong answer: ${output}")
  endif()
  message(STATUS "${what}: ${output}")
endfunction()

function(consume_by_cmake language)
  set(what "${language} by find_package")
  set(build "${SCRATCH}/${language}")
  run("${what}: configure" "${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/${language}" -B "${build}"
    -G "${GENERATOR}" -DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM} -DCMAKE_PREFIX_PATH=${prefix}
    -DCMAKE_BUILD_TYPE=${CONFIG} -DCMAKE_RUNTIME_OUTPUT_DIRECTORY=${build}/$<0:> ${ARGN})
  run("${what}: build" "${CMAKE_COMMAND}" --build "${build}" --config "${CONFIG}")
  expect_answer("${what}" "${build}/consumer")
endfunction()

function(consume_by_pkg_config language compiler source)
  set(what "${language} by pkg-config")
  run("${what}" "${CMAKE_COMMAND}" -E env "PKG_CONFIG_PATH=${prefix}/${LIBDIR}/pkgconfig"
    "${PKG_CONFIG}" --cflags --libs fuge)
  separate_arguments(flags UNIX_COMMAND "${output}")
  string(FIND "${flags}" "-L${prefix}" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "${what} does not lead to the installed copy: ${output}")
  endif()
  run("${what}: compile" "${compiler}" "${CMAKE_CURRENT_LIST_DIR}/${source}" -o "${SCRATCH}/${language}_pc" ${flags})
  # A shared library in a strange place is the user's to find.
  expect_answer("${what}" "${SCRATCH}/${language}_pc" "${CMAKE_COMMAND}" -E env
    "LD_LIBRARY_PATH=${prefix}/${LIBDIR}" "DYLD_LIBRARY_PATH=${prefix}/${LIBDIR}")
endfunction()

file(REMOVE_RECURSE "${SCRATCH}")
run("install" "${CMAKE_COMMAND}" -E env --unset=DESTDIR
  "${CMAKE_COMMAND}" --install "${BUILD_DIR}" --config "${CONFIG}" --prefix "${prefix}")
consume_by_cmake(c -DCMAKE_C_COMPILER=${C_COMPILER})
consume_by_cmake(fortran -DCMAKE_Fortran_COMPILER=${FORTRAN_COMPILER})
if(PKG_CONFIG)
  consume_by_pkg_config(c "${C_COMPILER}" c/main.c)
  consume_by_pkg_config(fortran "${FORTRAN_COMPILER}" fortran/main.f90)
endif()
