# With FUGE_WITH_FFTW=OFF the list of ctest has what needs no transforms, and a component that needs FFTW is refused.
# Nothing is built.
# ctest sets SOURCE_DIR, SCRATCH, GENERATOR, MAKE_PROGRAM and the compilers.
cmake_minimum_required(VERSION 3.20)

function(configure_without_fftw)
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -S "${SOURCE_DIR}" -B "${SCRATCH}" -G "${GENERATOR}"
      "-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}" -DCMAKE_C_COMPILER=${C_COMPILER} -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
      -DCMAKE_Fortran_COMPILER=${Fortran_COMPILER} -DFUGE_WITH_FFTW=OFF -DFUGE_SPARSE=OFF ${ARGN}
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  set(status "${status}" PARENT_SCOPE)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${SCRATCH}")
configure_without_fftw(-DFUGE_BUILD_TESTS=OFF -DFUGE_MPI=ON)
if(status EQUAL 0 OR NOT output MATCHES "FUGE_MPI needs FFTW: set FUGE_WITH_FFTW=ON, or FUGE_MPI=OFF")
  message(SEND_ERROR "FUGE_MPI=ON is not refused:\n${output}")
endif()

configure_without_fftw(-DFUGE_BUILD_TESTS=ON -DFUGE_BUILD_EXAMPLES=ON -DFUGE_MPI=AUTO)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "not configured:\n${output}")
endif()
execute_process(COMMAND "${CMAKE_CTEST_COMMAND}" --test-dir "${SCRATCH}" -N OUTPUT_VARIABLE list)
foreach(name IN ITEMS api_grids api_halfspace example_rough example_c_ball legacy_surfaces
    doc_tutorial_area_2 doc_tutorial_layers_2 example_coated_ball threads_pthreads mpi_same_answer_1)
  if(list MATCHES ": ${name}\n")
    message(SEND_ERROR "the list has ${name}, which needs FFTW")
  endif()
endforeach()
foreach(name IN ITEMS unit_bodies_halfplane_matrix unit_core_solver api_halfplane api_smooth example_punch legacy_solve
    doc_tutorial_fortran_1 without_fftw_c without_fftw_fortran)
  if(NOT list MATCHES ": ${name}\n")
    message(SEND_ERROR "the list does not have ${name}, which needs no FFTW")
  endif()
endforeach()

# Which test modules the unit tests call stands in their drivers, those of pFUnit or of the stand-in.
file(GLOB_RECURSE drivers "${SCRATCH}/test/unit_*.inc" "${SCRATCH}/test/fuge_compat/unit_*/driver.f90")
set(modules "")
foreach(driver IN LISTS drivers)
  file(READ "${driver}" text)
  string(APPEND modules "${text}")
endforeach()
foreach(name IN ITEMS halfplane_fft grid_plan)
  if(modules MATCHES "test_${name}(_suite|,)")
    message(SEND_ERROR "the unit tests have test_${name}, which needs FFTW")
  endif()
endforeach()
foreach(name IN ITEMS halfplane_influence solver_type)
  if(NOT modules MATCHES "test_${name}(_suite|,)")
    message(SEND_ERROR "the unit tests do not have test_${name}, which needs no FFTW")
  endif()
endforeach()
