# Reads the tables in src/ that say who may use whom: components.txt, and folders.txt of each component that has one.
#
#   fuge_component_folder(result src component)  the folder of a component below `src`: those of bodies lie in bodies/
#   fuge_component_of(result folder)             the component that a folder below `src` belongs to
#   fuge_read_uses(table prefix)  `names`: the rows of one table in order; <prefix><name>: what the row `name` lists;
#                                 budget_<name>: the numbers between the name and the colon, if any
#   fuge_read_all_uses(src)       all tables below the folder `src`:
#       components                the components in the order of components.txt
#       may_<component>           the components that a component may use
#       tabled                    the components that have folders.txt
#       folders_<component>       the folders of a component in the order of its folders.txt, as paths below `src`;
#                                 `core/.` is the facade
#       may_<folder>              the folders that a folder may use, as paths below `src`; a name that no folder has
#                                 stays as it is
function(fuge_component_folder result src component)
  if(IS_DIRECTORY "${src}/bodies/${component}")
    set(component "bodies/${component}")
  endif()
  set(${result} "${component}" PARENT_SCOPE)
endfunction()

function(fuge_component_of result folder)
  string(REGEX REPLACE "^bodies/" "" folder "${folder}")
  string(REGEX REPLACE "/.*" "" folder "${folder}")
  set(${result} "${folder}" PARENT_SCOPE)
endfunction()

macro(fuge_read_uses table prefix)
  set(names)
  file(STRINGS "${table}" rows REGEX "^[^#]")
  foreach(row IN LISTS rows)
    if(NOT row MATCHES "^([^ :]+)([ 0-9]*):(.*)$")
      message(FATAL_ERROR "${table}: not `name : names that it may use`: ${row}")
    endif()
    set(row_name "${CMAKE_MATCH_1}")
    set(row_numbers "${CMAKE_MATCH_2}")
    list(APPEND names "${row_name}")
    string(REGEX MATCHALL "[^ ]+" "${prefix}${row_name}" "${CMAKE_MATCH_3}")
    string(REGEX MATCHALL "[0-9]+" "budget_${row_name}" "${row_numbers}")
  endforeach()
endmacro()

# result: the folder that `name` means in the row of `folder`: one of a component, or one in `folder` or around it
function(fuge_find_used result src components folder name)
  fuge_component_of(first "${name}")
  string(REGEX REPLACE "/[.]$" "" around "${folder}")
  if(first IN_LIST components)
    string(REGEX REPLACE "^(bodies/)?${first}" "" inside "${name}")
    fuge_component_folder(name "${src}" "${first}")
    string(APPEND name "${inside}")
    set(around "")
  endif()
  while(around)
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
    fuge_component_folder(place "${src}" "${component}")
    if(NOT EXISTS "${src}/${place}/folders.txt")
      continue()
    endif()
    list(APPEND tabled "${component}")
    fuge_read_uses("${src}/${place}/folders.txt" "row_${place}/")
    list(TRANSFORM names PREPEND "${place}/" OUTPUT_VARIABLE "folders_${component}")
    foreach(folder IN LISTS "folders_${component}")
      set("may_${folder}")
      foreach(name IN LISTS "row_${folder}")
        fuge_find_used(used "${src}" "${components}" "${folder}" "${name}")
        list(APPEND "may_${folder}" "${used}")
      endforeach()
    endforeach()
  endforeach()
endmacro()
