# Headers, libraries, module files, CMake package, pkg-config files and documents.
#
# A static and a shared library may share a prefix: each has its own file of targets.
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/fuge")
get_target_property(library_type fuge TYPE)
set(library_kind shared)
if(library_type STREQUAL "STATIC_LIBRARY")
  set(library_kind static)
endif()
set(for_running COMPONENT fuge_runtime)
set(for_developers COMPONENT fuge_development)
set(for_readers COMPONENT fuge_documents)

set(fortran_compiler "${CMAKE_Fortran_COMPILER_ID}-${CMAKE_Fortran_COMPILER_VERSION}")

# result: linker flags for the libraries `...`
function(fuge_linker_flags result)
  set(libraries ${ARGN})
  list(TRANSFORM libraries PREPEND "-l" REGEX "^[^-/]")
  # Directories that the C compiler does not search by default.
  set(dirs ${fortran_runtime_dirs})
  list(REMOVE_ITEM dirs "" ${CMAKE_C_IMPLICIT_LINK_DIRECTORIES})
  list(TRANSFORM dirs PREPEND "-L")
  set(flags ${dirs} ${libraries})
  list(REMOVE_DUPLICATES flags)
  # Last, because any of the others may need it.
  list(REMOVE_ITEM flags -lm)
  list(APPEND flags -lm)
  list(JOIN flags " " flags)
  set(${result} "${flags}" PARENT_SCOPE)
endfunction()

# fuge_install_library(target package DESCRIPTION .. [REQUIRES package ..] [NEEDS library ..])
#
# Install the library, its targets file <package>-<kind>-targets.cmake and <package>.pc; NEEDS are the
# libraries that a static copy is linked with.
function(fuge_install_library target package)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "DESCRIPTION" "REQUIRES;NEEDS")
  set(targets_file "${package}-${library_kind}-targets")
  install(TARGETS ${target} EXPORT ${targets_file}
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" ${for_developers}
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" ${for_running}
      NAMELINK_COMPONENT fuge_development
    RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" ${for_running})
  install(EXPORT ${targets_file} NAMESPACE fuge:: DESTINATION "${package_dir}" ${for_developers})

  set(pc_name ${package})
  list(JOIN fuge_components " " pc_components)
  set(pc_description "${arg_DESCRIPTION}")
  list(JOIN arg_REQUIRES " " pc_requires)
  get_target_property(output_name ${target} OUTPUT_NAME)
  if(NOT output_name)
    set(output_name ${target})
  endif()
  set(pc_libs -l${output_name})
  fuge_linker_flags(pc_private ${arg_NEEDS} ${fortran_runtime})
  # A static library does not record what it needs, so these are always listed.
  if(library_kind STREQUAL "static")
    string(APPEND pc_libs " ${pc_private}")
    set(pc_private)
  endif()
  # The prefix relative to the .pc file, so that the installed tree can be moved.
  file(RELATIVE_PATH pc_to_prefix "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
  string(REGEX REPLACE "/$" "" pc_to_prefix "${pc_to_prefix}")
  configure_file(cmake/fuge.pc.in ${package}.pc @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/${package}.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" ${for_developers})
endfunction()

set(fftw)
set(with_fftw OFF)
if(FUGE_WITH_FFTW)
  set(with_fftw ON)
  set(fftw ${FFTW_THREADS_LIBRARY} ${FFTW_LIBRARY} ${FFTW_SINGLE_THREADS_LIBRARY} ${FFTW_SINGLE_LIBRARY})
endif()
fuge_install_library(fuge fuge DESCRIPTION "${PROJECT_DESCRIPTION}" NEEDS ${LAPACK_LIBRARIES} ${fftw})
# A static and a shared library in one prefix may differ in this.
set(features "fuge-${library_kind}-features.cmake")
set(feature_lines "set(fuge_WITH_FFTW ${with_fftw})\nset(fuge_COMPONENTS ${fuge_components})\n")
if(FUGE_WITH_FFTW AND FFTW_LIBRARY MATCHES "mkl")
  # Others would find FFTW, with its licence.
  string(APPEND feature_lines "set(fuge_FFTW_LIBRARY \"${FFTW_LIBRARY}\")\n")
endif()
file(WRITE "${PROJECT_BINARY_DIR}/${features}" "${feature_lines}")
install(FILES "${PROJECT_BINARY_DIR}/${features}" DESTINATION "${package_dir}" ${for_developers})

if(TARGET fuge_sparse)
  fuge_install_library(fuge_sparse fuge-sparse
    DESCRIPTION "Condensation of sparse stiffness matrices for fuge, by CHOLMOD" REQUIRES fuge NEEDS ${CHOLMOD_LIBRARY})
endif()

if(TARGET fuge_mpi)
  # The compiler wrappers of MPI know its libraries.
  fuge_install_library(fuge_mpi fuge-mpi
    DESCRIPTION "Surfaces over MPI for fuge: compile with the wrapper of the MPI" REQUIRES fuge)
endif()

install(DIRECTORY "${fuge_headers_dir}/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" ${for_developers}
  FILES_MATCHING PATTERN "*.h")
if(TARGET fuge_mpi)
  install(FILES src/mpi/include/fuge_mpi.h DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" ${for_developers})
endif()
# Only the public modules are for users. gfortran's files of these are complete in themselves; those of other
# compilers (flang) refer to the files of the modules that they use.
set(modules_dir "${PROJECT_BINARY_DIR}/modules")
if(CMAKE_Fortran_COMPILER_ID STREQUAL "GNU")
  set(modules ${fuge_components})
  list(TRANSFORM modules REPLACE "(.+)" "${modules_dir}/fuge_\\1.mod")
  install(FILES "${modules_dir}/fuge.mod" ${modules} DESTINATION "${FUGE_MODULE_DIR}" ${for_developers})
  if(TARGET fuge_sparse)
    install(FILES "${modules_dir}/fuge_sparse.mod" DESTINATION "${FUGE_MODULE_DIR}" ${for_developers})
  endif()
  if(TARGET fuge_mpi)
    install(FILES "${modules_dir}/fuge_mpi.mod" DESTINATION "${FUGE_MODULE_DIR}" ${for_developers})
  endif()
else()
  install(DIRECTORY "${modules_dir}/" DESTINATION "${FUGE_MODULE_DIR}" ${for_developers}
    FILES_MATCHING PATTERN "*.mod")
endif()

configure_package_config_file(cmake/fuge-config.cmake.in fuge-config.cmake
  INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file(fuge-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/fuge-config.cmake" "${PROJECT_BINARY_DIR}/fuge-config-version.cmake"
  cmake/FindFFTW.cmake cmake/FindCHOLMOD.cmake DESTINATION "${package_dir}" ${for_developers})

# The documents are made when they are installed, because their links depend on what is.
set(doc_dir "${CMAKE_INSTALL_DOCDIR}")
set(doc_full_dir "${CMAKE_INSTALL_FULL_DOCDIR}")
if(NOT is_top_level)
  # The folder may be that of the project around this one.
  set(doc_dir "${CMAKE_INSTALL_DATAROOTDIR}/doc/fuge")
  set(doc_full_dir "${CMAKE_INSTALL_FULL_DATAROOTDIR}/doc/fuge")
endif()
file(GLOB headers RELATIVE "${fuge_headers_dir}" CONFIGURE_DEPENDS "${fuge_headers_dir}/*.h")
if(TARGET fuge_mpi)
  list(APPEND headers fuge_mpi.h)
endif()
file(RELATIVE_PATH to_headers "${doc_full_dir}" "${CMAKE_INSTALL_FULL_INCLUDEDIR}")
set(documents "${PROJECT_BINARY_DIR}/documents")
install(CODE "
  set(SOURCE_DIR [[${PROJECT_SOURCE_DIR}]])
  set(DOCUMENTS [[${documents}]])
  set(HEADERS [[${headers}]])
  set(TO_HEADERS [[${to_headers}]])
  set(COMPONENTS [[${fuge_components}]])" ${for_readers})
install(SCRIPT cmake/documents.cmake ${for_readers})
install(DIRECTORY "${documents}/" DESTINATION "${doc_dir}" ${for_readers})
install(FILES doc/man/fuge.3 DESTINATION "${CMAKE_INSTALL_MANDIR}/man3" ${for_readers})
