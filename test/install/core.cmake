# The component core alone: it is built, its tests are those of the core, it is installed with its interface and its
# documents only, and programs in Fortran and C use it; what is not there is refused by name.
# ctest sets SOURCE_DIR, SCRATCH, GENERATOR, MAKE_PROGRAM, BUILT, TAKING, WITH_FFTW, LIBDIR, DOCDIR, INCLUDEDIR,
# MODULEDIR, the compilers and COMPILER_ID.
cmake_minimum_required(VERSION 3.20)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

file(REMOVE_RECURSE "${SCRATCH}")
set(prefix "${SCRATCH}/prefix")
prepare_compiling()
set(settings -G "${GENERATOR}" "-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}" "-DCMAKE_C_COMPILER=${C_COMPILER}"
  "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}" "-DCMAKE_Fortran_COMPILER=${Fortran_COMPILER}")
run("configure" "${CMAKE_COMMAND}" -S "${SOURCE_DIR}" -B "${SCRATCH}/build" ${settings} ${TAKING}
  -DCMAKE_BUILD_TYPE=Release -DFUGE_COMPONENTS=core -DFUGE_WITH_FFTW=${WITH_FFTW} -DFUGE_BUILD_TESTS=ON
  -DCMAKE_INSTALL_LIBDIR=${LIBDIR})
run("build" ${compiling} "${CMAKE_COMMAND}" --build "${SCRATCH}/build" --parallel 2
  --target fuge api_dense api_problem api_header_c99 unit_core_base)
run("some tests" "${CMAKE_COMMAND}" -E chdir "${SCRATCH}/build" ctest --output-on-failure
  -R "^(api_dense|api_problem|api_header_c99|unit_core_base)$")

# The tests of the core are there, and no others.
run("list of tests" "${CMAKE_COMMAND}" -E chdir "${SCRATCH}/build" ctest -N)
string(REGEX MATCHALL "unit_[a-z_]+|api_[a-z_]+" tests "${output}")
foreach(test IN ITEMS unit_core_problem unit_core_solver_path unit_core_products unit_topics api_dense api_problem)
  if(NOT test IN_LIST tests)
    message(SEND_ERROR "the core's test ${test} is left out:\n${output}")
  endif()
endforeach()
set(strange ${tests})
list(FILTER strange INCLUDE REGEX "^unit_(bodies|fe|files)|^api_(halfplane|halfspace|pairs|smooth|mesh)")
if(strange)
  message(SEND_ERROR "tests of other components: ${strange}")
endif()

# The rest of the tests is not to be built, so that the library and what is around it are installed one by one.
foreach(part IN ITEMS runtime development documents)
  run("install ${part}" "${CMAKE_COMMAND}" -E env --unset=DESTDIR "${CMAKE_COMMAND}" --install "${SCRATCH}/build"
    --prefix "${prefix}" --component fuge_${part})
endforeach()
file(GLOB headers RELATIVE "${prefix}/${INCLUDEDIR}" "${prefix}/${INCLUDEDIR}/*")
if(NOT headers STREQUAL "fuge.h;fuge_core.h")
  message(SEND_ERROR "installed headers: ${headers}")
endif()
if(COMPILER_ID STREQUAL "GNU")
  file(GLOB modules RELATIVE "${prefix}/${MODULEDIR}" "${prefix}/${MODULEDIR}/*")
  if(NOT modules STREQUAL "fuge.mod;fuge_core.mod")
    message(SEND_ERROR "installed modules: ${modules}")
  endif()
endif()
file(READ "${prefix}/${DOCDIR}/doc/fortran.md" page)
if(NOT page MATCHES "## core/solver" OR page MATCHES "## bodies/")
  message(SEND_ERROR "fortran.md is not about the core alone")
endif()

# Consumers.
run("consumer: configure" "${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/core" -B "${SCRATCH}/consumer" ${settings}
  "-DCMAKE_PREFIX_PATH=${prefix}" -DCMAKE_BUILD_TYPE=Release)
run("consumer: build" "${CMAKE_COMMAND}" --build "${SCRATCH}/consumer")
expect_answer("Fortran and the core alone" "${SCRATCH}/consumer/consumer")
expect_answer("C and the core alone" "${SCRATCH}/consumer/consumer_c")
execute_process(COMMAND "${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/components" -B "${SCRATCH}/refused" ${settings}
  "-DCMAKE_PREFIX_PATH=${prefix}" "-DCOMPONENTS=halfspace" RESULT_VARIABLE status OUTPUT_VARIABLE output
  ERROR_VARIABLE output)
string(REGEX REPLACE "[ \n]+" " " output "${output}")
if(status EQUAL 0
    OR NOT output MATCHES "was built without halfspace .FUGE_COMPONENTS.. Components of this copy: core, ")
  message(SEND_ERROR "the component halfspace is not refused: ${output}")
endif()
# Other subsets can be configured, with their tests.
foreach(component IN ITEMS halfplane halfspace layers punches fe files accuracy)
  run("configure ${component}" "${CMAKE_COMMAND}" -S "${SOURCE_DIR}" -B "${SCRATCH}/${component}" ${settings}
    -DFUGE_COMPONENTS=${component} -DFUGE_WITH_FFTW=${WITH_FFTW} -DFUGE_BUILD_TESTS=ON)
endforeach()
# The benchmark needs what the tests need, without them.
if(WITH_FFTW)
  run("configure the benchmark" "${CMAKE_COMMAND}" -S "${SOURCE_DIR}" -B "${SCRATCH}/bench" ${settings}
    -DFUGE_BUILD_BENCH=ON -DFUGE_BUILD_TESTS=OFF -DFUGE_BUILD_EXAMPLES=OFF)
endif()
# A component that does not exist is refused when it is configured.
execute_process(COMMAND "${CMAKE_COMMAND}" -S "${SOURCE_DIR}" -B "${SCRATCH}/nonsense" ${settings}
  "-DFUGE_COMPONENTS=core\;district" RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(status EQUAL 0 OR NOT output MATCHES "FUGE_COMPONENTS names \"district\"")
  message(SEND_ERROR "the component district is not refused: ${output}")
endif()
