# The labels of what has to be tested: cmake -D SRC=src -D "FOLDERS=halfspace core/solver/path" -P users.cmake
#
# Prints the components and folders of src/ that are named or may use one of those, directly or through others, as a
# pattern of labels for ctest. Nothing, and a message, if there is no component or folder of such a name.
cmake_minimum_required(VERSION 3.20)
include("${CMAKE_CURRENT_LIST_DIR}/uses.cmake")

get_filename_component(SRC "${SRC}" REALPATH)
fuge_read_all_uses("${SRC}")
set(all ${components})
foreach(component IN LISTS tabled)
  list(APPEND all ${folders_${component}})
endforeach()

string(REPLACE " " ";" found "${FOLDERS}")
foreach(folder IN LISTS found)
  if(NOT ";${all};" MATCHES ";${folder}[;/]")
    message("fuge: \"${folder}\" is no component or folder of src/, see src/components.txt and folders.txt there")
    return()
  endif()
endforeach()

# result: is `folder`, or one around it, among those found?
function(is_found result folder)
  set(${result} FALSE PARENT_SCOPE)
  fuge_component_of(component "${folder}")
  foreach(one IN LISTS found)
    if("${folder}/" MATCHES "^${one}/" OR component STREQUAL one)
      set(${result} TRUE PARENT_SCOPE)
      break()
    endif()
  endforeach()
endfunction()

# A component stands before its folders, and each row after what it may use: one pass finds them all.
foreach(user IN LISTS all)
  foreach(name IN LISTS user "may_${user}")
    is_found(is_user "${name}")
    if(is_user)
      list(APPEND found "${user}")
      break()
    endif()
  endforeach()
endforeach()
list(REMOVE_DUPLICATES found)
list(JOIN found "|" pattern)
execute_process(COMMAND "${CMAKE_COMMAND}" -E echo
  "^(topics|hard|structure|legacy|sparse|${pattern})$")
