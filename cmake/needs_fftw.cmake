# fuge_needs_fftw(result text ..): can what has these texts in its source not run with this build, because it needs
# operators by FFT, stresses on grids or transforms, and FUGE_WITH_FFTW is off?
#
# Tests and examples of which this is true are not part of the build, and so not in the list of ctest.
set(fuge_of_fftw
  "(halfplane|halfspace)_?operator|operator_(halfplane|halfspace)|(stress|displacement)_grid|fugefx[^a-z]"
  "fft_plan|set_grid_store|use fuge_(convolution|grid_convolution|grid_plan|grid_waves|halfspace_waves)")
list(JOIN fuge_of_fftw "|" fuge_of_fftw)

function(fuge_needs_fftw result)
  string(TOLOWER "${ARGN}" text)
  set(needed FALSE)
  if(NOT FUGE_WITH_FFTW AND text MATCHES "${fuge_of_fftw}")
    set(needed TRUE)
  endif()
  set(${result} ${needed} PARENT_SCOPE)
endfunction()

# The same for files.
function(fuge_files_need_fftw result)
  set(texts "")
  if(NOT FUGE_WITH_FFTW)
    foreach(file IN LISTS ARGN)
      file(READ "${file}" text)
      string(APPEND texts "${text}")
    endforeach()
  endif()
  fuge_needs_fftw(needed "${texts}")
  set(${result} ${needed} PARENT_SCOPE)
endfunction()
