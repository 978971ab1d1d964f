# Reads the tables in src/ that say who may use whom: components.txt, and folders.txt of each component that has one.
#
#   fuge_read_uses(table prefix)  `names`: the rows of one table in order; <prefix><name>: what the row `name` lists
#   fuge_read_all_uses(src)       all tables below the folder `src`:
#       components                the components in the order of components.txt
#       may_<component>           the components that a component may use
#       tabled                    the components that have folders.txt
#       folders_<component>       the folders of a component in the order of its folders.txt, as paths below `src`;
#                                 `core/.` is the facade
#       may_<folder>              the folders that a folder may use, as paths below `src`; a name that no folder has
#                                 stays as it is
macro(fuge_read_uses table prefix)
  set(names)
  file(STRINGS "${table}" rows REGEX "^[^#]")
  foreach(row IN LISTS rows)
    if(NOT row MATCHES "^([^ :]+) *:(.*)$")
      message(FATAL_ERROR "${table}: not `name : names that it may use`: ${row}")
    endif()
    list(APPEND names "${CMAKE_MATCH_1}")
    string(REGEX MATCHALL "[^ ]+" "${prefix}${CMAKE_MATCH_1}" "${CMAKE_MATCH_2}")
  endforeach()
endmacro()

# result: the folder that `name` means in the row of `folder`: one of a component, or one in `folder` or around it
function(fuge_find_used result src components folder name)
  string(REGEX REPLACE "/.*" "" first "${name}")
  string(REGEX REPLACE "/[.]$" "" around "${folder}")
  while(around AND NOT first IN_LIST components)
    if(IS_DIRECTORY "${src}/${around}/${name}")
      set(name "${around}/${name}")
      break()
    endif()
    get_filename_component(around "${around}" DIRECTORY)
  endwhile()
  set(${result} "${name}" PARENT_SCOPE)
endfunction()

macro(fuge_read_all_uses src)
  fuge_read_uses("${src}/components.txt" may_)
  set(components ${names})
  set(tabled)
  foreach(component IN LISTS components)
    if(NOT EXISTS "${src}/${component}/folders.txt")
      continue()
    endif()
    list(APPEND tabled "${component}")
    fuge_read_uses("${src}/${component}/folders.txt" "row_${component}/")
    list(TRANSFORM names PREPEND "${component}/" OUTPUT_VARIABLE "folders_${component}")
    foreach(folder IN LISTS "folders_${component}")
      set("may_${folder}")
      foreach(name IN LISTS "row_${folder}")
        fuge_find_used(used "${src}" "${components}" "${folder}" "${name}")
        list(APPEND "may_${folder}" "${used}")
      endforeach()
    endforeach()
  endforeach()
endmacro()
