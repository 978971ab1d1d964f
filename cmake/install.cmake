# Header, library, module files, CMake package and pkg-config file.
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/fuge")

install(TARGETS fuge EXPORT fuge-targets
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
install(FILES include/fuge.h include/fuge_fe.h include/fuge_smooth.h DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(DIRECTORY "${PROJECT_BINARY_DIR}/modules/" DESTINATION "${FUGE_MODULE_DIR}"
  FILES_MATCHING PATTERN "*.mod" PATTERN "*.smod")
install(EXPORT fuge-targets NAMESPACE fuge:: DESTINATION "${package_dir}")

get_target_property(library_type fuge TYPE)
# What a C linker has to add for a static Fortran library.
set(fortran_runtime ${CMAKE_Fortran_IMPLICIT_LINK_LIBRARIES})
list(REMOVE_ITEM fortran_runtime gcc gcc_s c)
list(REMOVE_DUPLICATES fortran_runtime)
set(fortran_runtime_dirs ${CMAKE_Fortran_IMPLICIT_LINK_DIRECTORIES})

configure_package_config_file(cmake/fuge-config.cmake.in fuge-config.cmake
  INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file(fuge-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/fuge-config.cmake" "${PROJECT_BINARY_DIR}/fuge-config-version.cmake"
  DESTINATION "${package_dir}")
if(library_type STREQUAL "STATIC_LIBRARY")
  install(FILES cmake/FindFFTW.cmake DESTINATION "${package_dir}")
endif()

# A static library has no record of what it needs: then these are needed always.
set(pc_libs -lfuge)
if(library_type STREQUAL "STATIC_LIBRARY")
  set(pc_libraries ${LAPACK_LIBRARIES} ${FFTW_THREADS_LIBRARY} ${FFTW_LIBRARY} ${fortran_runtime})
  list(TRANSFORM pc_libraries PREPEND "-l" REGEX "^[^-/]")
  # Directories that the C compiler does not search by itself.
  set(pc_dirs ${fortran_runtime_dirs})
  list(REMOVE_ITEM pc_dirs "" ${CMAKE_C_IMPLICIT_LINK_DIRECTORIES})
  list(TRANSFORM pc_dirs PREPEND "-L")
  list(APPEND pc_libs ${pc_dirs} ${pc_libraries})
  list(REMOVE_DUPLICATES pc_libs)
  # All of the others may need it.
  list(REMOVE_ITEM pc_libs -lm)
  list(APPEND pc_libs -lm)
endif()
list(JOIN pc_libs " " pc_libs)
# The prefix seen from the .pc file, so that the installed tree can be moved.
file(RELATIVE_PATH pc_to_prefix "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
string(REGEX REPLACE "/$" "" pc_to_prefix "${pc_to_prefix}")
configure_file(cmake/fuge.pc.in fuge.pc @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/fuge.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
