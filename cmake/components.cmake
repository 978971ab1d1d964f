# Which components of src/ are built: FUGE_COMPONENTS and those that they use, as src/components.txt has them, in
# `fuge_components`; the others in `fuge_left_out_components`.
set(FUGE_COMPONENTS core area punch stress fe files CACHE STRING
  "Components of the library, a list: what they use is built with them")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS src/components.txt)

# `all_components`, and uses_<component> of each, those that it uses first.
set(all_components)
file(STRINGS src/components.txt component_lines REGEX "^[a-z]")
foreach(line IN LISTS component_lines)
  string(REGEX MATCH "^([a-z0-9]+) *: *(.*)$" line "${line}")
  list(APPEND all_components "${CMAKE_MATCH_1}")
  string(REPLACE " " ";" "uses_${CMAKE_MATCH_1}" "${CMAKE_MATCH_2}")
endforeach()
# The facade uses just the six.
set(fuge_all_components ${uses_facade})

set(fuge_components)
set(asked ${FUGE_COMPONENTS})
while(asked)
  list(POP_FRONT asked component)
  if(NOT component IN_LIST fuge_all_components)
    list(JOIN fuge_all_components ", " choices)
    message(FATAL_ERROR "fuge: FUGE_COMPONENTS names \"${component}\": choose from ${choices}")
  endif()
  if(NOT component IN_LIST fuge_components)
    list(APPEND fuge_components "${component}")
    list(APPEND asked ${uses_${component}})
  endif()
endwhile()
set(fuge_left_out_components ${fuge_all_components})
list(REMOVE_ITEM fuge_left_out_components ${fuge_components})
if(fuge_left_out_components)
  list(JOIN fuge_components ", " built)
  message(STATUS "fuge: components ${built}")
endif()
