# FFTW in double and single precision: targets FFTW::fftw, and FFTW::threads, which has the locks of its planners and
# single precision too.
# FFTW_ROOT or CMAKE_PREFIX_PATH leads to a copy in a nonstandard location. FFTW_LIBRARY may be another library with
# FFTW's interface, such as libmkl_rt of MKL.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(PC_FFTW QUIET fftw3)
endif()
find_library(FFTW_LIBRARY NAMES fftw3 libfftw3-3 HINTS ${PC_FFTW_LIBRARY_DIRS})
if(FFTW_LIBRARY MATCHES "mkl")
  # One library has all of it.
  set(FFTW_THREADS_LIBRARY "${FFTW_LIBRARY}")
  set(FFTW_SINGLE_LIBRARY "${FFTW_LIBRARY}")
  set(FFTW_SINGLE_THREADS_LIBRARY "${FFTW_LIBRARY}")
else()
  find_library(FFTW_THREADS_LIBRARY NAMES fftw3_threads HINTS ${PC_FFTW_LIBRARY_DIRS})
  find_library(FFTW_SINGLE_LIBRARY NAMES fftw3f libfftw3f-3 HINTS ${PC_FFTW_LIBRARY_DIRS})
  find_library(FFTW_SINGLE_THREADS_LIBRARY NAMES fftw3f_threads HINTS ${PC_FFTW_LIBRARY_DIRS})
endif()
mark_as_advanced(FFTW_LIBRARY FFTW_THREADS_LIBRARY FFTW_SINGLE_LIBRARY FFTW_SINGLE_THREADS_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(FFTW REQUIRED_VARS FFTW_LIBRARY FFTW_THREADS_LIBRARY
  FFTW_SINGLE_LIBRARY FFTW_SINGLE_THREADS_LIBRARY
  REASON_FAILURE_MESSAGE "install FFTW 3.3.6 or newer in both precisions and with threads (Debian: libfftw3-dev)")

if(FFTW_FOUND AND NOT TARGET FFTW::threads)
  # A static copy does not name the libraries that it needs.
  set(fftw_needs)
  if(UNIX)
    set(fftw_needs pthread m)
  endif()
  add_library(FFTW::fftw UNKNOWN IMPORTED)
  set_target_properties(FFTW::fftw PROPERTIES
    IMPORTED_LOCATION "${FFTW_LIBRARY}" INTERFACE_LINK_LIBRARIES "${fftw_needs}")
  add_library(FFTW::threads UNKNOWN IMPORTED)
  set_target_properties(FFTW::threads PROPERTIES
    IMPORTED_LOCATION "${FFTW_THREADS_LIBRARY}"
    INTERFACE_LINK_LIBRARIES "${FFTW_SINGLE_THREADS_LIBRARY};${FFTW_SINGLE_LIBRARY};FFTW::fftw")
  unset(fftw_needs)
endif()
