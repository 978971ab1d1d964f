# What the scripts of these tests share. LIBDIR and SCRATCH are set by ctest; those that build the library anew have
# also SOURCE_DIR, MAKE_PROGRAM, and in BUILT a build by Ninja whose objects they may take, or nothing.
set(answer "force +2\\.000 +0\\.000 +gap +0\\.000 +0\\.800 +approach +0\\.400")

# Run a command; stop the test if it fails. Its output is in `output`.
function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${what} failed (${status}): ${command}\n${output}\n${errors}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# With a build in BUILT: `compiling` begins a command that compiles the library and may take objects from there, where
# take_built.sh runs the compiler, and `flags` are the Fortran flags of that build. Without one they stay as they are.
set(compiling)
function(prepare_compiling)
  if(BUILT)
    run("flags of ${BUILT}" "${MAKE_PROGRAM}" -C "${BUILT}" -t commands -s src/CMakeFiles/fuge.dir/facade/fuge.f90.o)
    string(REGEX REPLACE "^[^ ]+| -[IJ][^ ]+| -fPIC| -nocpp| -Werror| -Wframe-larger-than=[0-9]+| -fimplicit-none|\
 -c [^ ]+| -o [^ ]+|\n" "" flags "${output}")
    set(flags "${flags}" PARENT_SCOPE)
    set(compiling "${CMAKE_COMMAND}" -E env "BUILT=${BUILT}" "FLAGS=${flags}" "SOURCE_DIR=${SOURCE_DIR}" PARENT_SCOPE)
  endif()
endfunction()

# Run a consumer, `...`, and look at what it prints.
function(expect_answer what)
  run("${what}: run" ${ARGN})
  if(NOT output MATCHES "${answer}")
    message(FATAL_ERROR "${what} printed the wrong answer: ${output}")
  endif()
  string(STRIP "${output}" output)
  message(STATUS "${what}: ${output}")
  set(output "${output}" PARENT_SCOPE)
endfunction()

# A shared library in a strange place is the user's to find.
function(expect_answer_in prefix what)
  if(NOT prefix)
    expect_answer("${what}" ${ARGN})
  else()
    expect_answer("${what}" "${CMAKE_COMMAND}" -E env
      "LD_LIBRARY_PATH=${prefix}/${LIBDIR}" "DYLD_LIBRARY_PATH=${prefix}/${LIBDIR}" ${ARGN})
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# result: what pkg-config answers for the copy in `prefix`
function(ask_pkg_config result prefix)
  run("pkg-config" "${CMAKE_COMMAND}" -E env "PKG_CONFIG_PATH=${prefix}/${LIBDIR}/pkgconfig" "${PKG_CONFIG}" ${ARGN})
  string(STRIP "${output}" output)
  set(${result} "${output}" PARENT_SCOPE)
endfunction()
