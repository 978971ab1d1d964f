# Which sources of tests and examples go with this build? Those that need FFTW where FUGE_WITH_FFTW is off, and those
# that use a component that FUGE_COMPONENTS leaves out, are not part of the build, and so not in the list of ctest.
#
#   fuge_is_left_out(result text ..)          is what has these texts in its source left out?
#   fuge_files_are_left_out(result file ..)   the same for files
#   fuge_components_of_files(result file ..)  the components beside core whose modules, procedures or functions they
#                                             use, in the order of components.txt; core if there are none

# Operators by FFT, stresses on grids, transforms.
set(fuge_of_fftw
  "(halfplane|halfspace)_?operator|operator_(layered_)?(halfplane|halfspace)|fugefx[^a-z]"
  "(stress|displacement)_grid|_interfaces"
  "%set_grid|fuge_field_[a-z_]*grid"
  "(fft|line|split)_plan|kept_rows|set_grid_store|fuge_solve_(line|area)[^a-z]"
  "use fuge_(convolution|grid_convolution|grid_plan|grid_waves|halfspace_waves)")
list(JOIN fuge_of_fftw "|" fuge_of_fftw)

# fuge_owner_<name>, in lower case: the component that has the module, that exports the Fortran name, or whose header
# declares the C function.
foreach(component IN LISTS fuge_all_components)
  fuge_component_folder(folder "${PROJECT_SOURCE_DIR}/src" "${component}")
  file(GLOB_RECURSE names CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/${folder}/*.f90")
  list(TRANSFORM names REPLACE "^.*/|[.]f90$" "")
  file(READ "${PROJECT_SOURCE_DIR}/src/${folder}/fuge_${component}.f90" text)
  string(TOLOWER "${text}" text)
  # The arguments of `only:`, which go on in the next lines.
  string(REGEX REPLACE "use [a-z_0-9]+, only:" "" text "${text}")
  string(REGEX MATCHALL "fuge_[a-z_0-9]+" exported "${text}")
  file(READ "${PROJECT_SOURCE_DIR}/include/fuge_${component}.h" text)
  string(REGEX REPLACE "/[*]([^*]|[*]+[^*/])*[*]+/" "" text "${text}")
  string(REGEX MATCHALL "fuge_[a-z_0-9]+[(]" declared "${text}")
  list(TRANSFORM declared REPLACE "[(]" "")
  foreach(name IN LISTS names exported declared)
    if(NOT DEFINED "fuge_owner_${name}")
      set("fuge_owner_${name}" "${component}")
    endif()
  endforeach()
endforeach()

# The components whose names the texts have.
function(fuge_components_of_text result)
  string(TOLOWER "${ARGN}" text)
  string(REGEX MATCHALL "fuge_[a-z_0-9]+" names "${text}")
  list(REMOVE_DUPLICATES names)
  set(components)
  foreach(name IN LISTS names)
    if(DEFINED "fuge_owner_${name}")
      list(APPEND components "${fuge_owner_${name}}")
    endif()
  endforeach()
  list(REMOVE_DUPLICATES components)
  set(${result} "${components}" PARENT_SCOPE)
endfunction()

function(fuge_read_files result)
  set(texts "")
  foreach(file IN LISTS ARGN)
    file(READ "${file}" text)
    string(APPEND texts "${text}")
  endforeach()
  set(${result} "${texts}" PARENT_SCOPE)
endfunction()

function(fuge_components_of_files result)
  fuge_read_files(texts ${ARGN})
  fuge_components_of_text(used "${texts}")
  set(found)
  foreach(component IN LISTS fuge_all_components)
    if(component IN_LIST used AND NOT component STREQUAL "core")
      list(APPEND found "${component}")
    endif()
  endforeach()
  if(NOT found)
    set(found core)
  endif()
  set(${result} "${found}" PARENT_SCOPE)
endfunction()

function(fuge_is_left_out result)
  set(left_out FALSE)
  string(TOLOWER "${ARGN}" text)
  if(NOT FUGE_WITH_FFTW AND text MATCHES "${fuge_of_fftw}")
    set(left_out TRUE)
  elseif(fuge_left_out_components)
    fuge_components_of_text(components "${text}")
    # Procedures for FORTRAN 77 that condense bodies.
    if(text MATCHES "fuge[cr]b[^a-z]")
      list(APPEND components fe)
    endif()
    foreach(component IN LISTS fuge_left_out_components)
      if(component IN_LIST components)
        set(left_out TRUE)
      endif()
    endforeach()
    # Modules of test/support that are left out themselves.
    foreach(module IN LISTS fuge_left_out_modules)
      if(text MATCHES "\n *use ${module}[, \n]")
        set(left_out TRUE)
      endif()
    endforeach()
  endif()
  set(${result} ${left_out} PARENT_SCOPE)
endfunction()

function(fuge_files_are_left_out result)
  set(left_out FALSE)
  if(NOT FUGE_WITH_FFTW OR fuge_left_out_components)
    fuge_read_files(texts ${ARGN})
    fuge_is_left_out(left_out "${texts}")
  endif()
  set(${result} ${left_out} PARENT_SCOPE)
endfunction()
