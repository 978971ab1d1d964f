# Debian packages by `cpack -G DEB`, from a build with shared libraries.
#
# Each package is a component of its own, which only CPack installs: cmake/package_files.cmake takes its files from an
# installation of the whole.
set(fuge_soversion ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(FUGE_PACKAGE_MAINTAINER "The fuge authors <fuge@localhost>" CACHE STRING "Maintainer of the Debian packages")
mark_as_advanced(FUGE_PACKAGE_MAINTAINER)
get_target_property(fuge_library_type fuge TYPE)
if(NOT is_top_level OR NOT fuge_library_type STREQUAL "SHARED_LIBRARY" OR NOT CMAKE_SYSTEM_NAME STREQUAL "Linux")
  return()
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_SOURCE_GENERATOR "")
set(CPACK_PACKAGE_NAME fuge)
set(CPACK_PACKAGE_VENDOR "The fuge authors")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${FUGE_PACKAGE_MAINTAINER}")
# The home page is the repository, as soon as script/release --address has written it.
file(STRINGS "${PROJECT_SOURCE_DIR}/CITATION.cff" address REGEX "^repository-code: ")
string(REPLACE "repository-code: " "" address "${address}")
if(NOT address MATCHES "your[.]server")
  set(CPACK_DEBIAN_PACKAGE_HOMEPAGE "${address}")
endif()
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
# When the packages that need a library are made, the package of that library does not exist yet.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}/src" "${PROJECT_BINARY_DIR}/src/sparse")
set(stage "${PROJECT_BINARY_DIR}/packages/all")
set(CPACK_INSTALL_COMMANDS
  "\"${CMAKE_COMMAND}\" -E rm -rf \"${stage}\""
  "\"${CMAKE_COMMAND}\" -E env --unset=DESTDIR \"${CMAKE_COMMAND}\" --install \"${PROJECT_BINARY_DIR}\" --strip \
--prefix \"${stage}\"")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
file(WRITE "${PROJECT_BINARY_DIR}/packages/triggers" "activate-noawait ldconfig\n")
# Each package has a summary of its own.
file(WRITE "${PROJECT_BINARY_DIR}/packages/cpack.cmake" "set(CPACK_PACKAGE_DESCRIPTION_SUMMARY)\n")
set(CPACK_PROJECT_CONFIG_FILE "${PROJECT_BINARY_DIR}/packages/cpack.cmake")

set(description "fuge finds the points at which elastic bodies touch, the contact
forces, the gaps and the rigid approach, from an influence matrix or by
fast Fourier transforms on half-planes and half-spaces, exactly and with
a certificate.")

# The package of the compiler brings the commands gfortran and cc. Compilers of another version may do if they read the
# same version of module files.
set(for_fortran)
if(CMAKE_Fortran_COMPILER_ID STREQUAL "GNU" AND CMAKE_Fortran_COMPILER_VERSION VERSION_GREATER_EQUAL 8
    AND CMAKE_Fortran_COMPILER_VERSION VERSION_LESS 15)
  set(for_fortran ", gfortran | gfortran-mod-15")
endif()

# fuge_package(name SECTION .. ABOUT .. [DEPENDS .. ] [RECOMMENDS ..] [FOR_ALL] FILES pattern ..)
#
# A package of the files below the prefix that one of the regular expressions matches, without those that an earlier
# package has; FOR_ALL architectures.
set(fuge_packages)
set(fuge_packaged)
macro(fuge_package name)
  cmake_parse_arguments(package "FOR_ALL" "SECTION;ABOUT;DEPENDS;RECOMMENDS" "FILES" ${ARGN})
  string(TOUPPER "${name}" key)
  list(APPEND fuge_packages "${name}")
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME "${name}")
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION "${package_SECTION}")
  set(CPACK_COMPONENT_${key}_DESCRIPTION "${package_ABOUT}\n${description}")
  if(package_DEPENDS)
    set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${package_DEPENDS}")
  endif()
  if(package_RECOMMENDS)
    set(CPACK_DEBIAN_${key}_PACKAGE_RECOMMENDS "${package_RECOMMENDS}")
  endif()
  if("${package_SECTION}" STREQUAL "libs")
    set(CPACK_DEBIAN_${key}_PACKAGE_CONTROL_EXTRA "${PROJECT_BINARY_DIR}/packages/triggers")
  endif()
  if(package_FOR_ALL)
    set(CPACK_DEBIAN_${key}_PACKAGE_ARCHITECTURE all)
    set(CPACK_DEBIAN_${key}_PACKAGE_SHLIBDEPS OFF)
  endif()
  install(CODE "
    set(PACKAGE ${name})
    set(FILES [[${package_FILES}]])
    set(EXCEPT [[${fuge_packaged}]])
    set(STAGE [[${stage}]])
    set(LINKS [[${links}]])
    set(SOURCE_DIR [[${PROJECT_SOURCE_DIR}]])
    set(VERSION ${PROJECT_VERSION})
    set(MAINTAINER [[${FUGE_PACKAGE_MAINTAINER}]])
    include([[${PROJECT_SOURCE_DIR}/cmake/package_files.cmake]])" COMPONENT ${name} EXCLUDE_FROM_ALL)
  list(APPEND fuge_packaged ${package_FILES})
endmacro()

set(links "The libraries that the package depends on have licences of their own; FFTW and parts of CHOLMOD are under \
the GPL.")
set(exactly "(= ${PROJECT_VERSION})")
fuge_package(libfuge${fuge_soversion} SECTION libs
  ABOUT "frictionless elastic contact, shared library" FILES "^lib[^ ]*/libfuge\\.so\\..*")
if(TARGET fuge_sparse)
  fuge_package(libfuge-sparse${fuge_soversion} SECTION libs DEPENDS "libfuge${fuge_soversion} ${exactly}"
    ABOUT "frictionless elastic contact, sparse stiffness matrices" FILES "^lib[^ ]*/libfuge_sparse\\.so\\..*")
  fuge_package(libfuge-sparse-dev SECTION libdevel
    DEPENDS "libfuge-dev ${exactly}, libfuge-sparse${fuge_soversion} ${exactly}${for_fortran}"
    ABOUT "frictionless elastic contact, development files for sparse matrices"
    FILES "^lib.*/libfuge_sparse\\.so$" "^lib.*/fuge-sparse[^/]*$" "^lib.*/fuge_sparse-[^/]*$"
      "^lib.*/fuge_sparse\\.mod$")
endif()
if(TARGET fuge_mpi)
  fuge_package(libfuge-mpi${fuge_soversion} SECTION libs DEPENDS "libfuge${fuge_soversion} ${exactly}"
    ABOUT "frictionless elastic contact, surfaces over MPI" FILES "^lib[^ ]*/libfuge_mpi\\.so\\..*")
  fuge_package(libfuge-mpi-dev SECTION libdevel
    DEPENDS "libfuge-dev ${exactly}, libfuge-mpi${fuge_soversion} ${exactly}, mpi-default-dev${for_fortran}"
    ABOUT "frictionless elastic contact, development files for MPI"
    FILES "^lib.*/libfuge_mpi\\.so$" "^lib.*/fuge-mpi[^/]*$" "^lib.*/fuge_mpi-[^/]*$" "^lib.*/fuge_mpi\\.mod$"
      "^include/fuge_mpi\\.h$")
endif()
fuge_package(libfuge-dev SECTION libdevel DEPENDS "libfuge${fuge_soversion} ${exactly}${for_fortran}"
  RECOMMENDS "pkg-config"
  ABOUT "frictionless elastic contact, development files for C and Fortran" FILES "^lib" "^include/" "/man3/")
fuge_package(fuge-doc FOR_ALL SECTION doc ABOUT "frictionless elastic contact, manual" FILES "^share/doc/")

set(CPACK_COMPONENTS_ALL ${fuge_packages})
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
include(CPack)
