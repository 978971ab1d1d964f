# fuge_link_fortran_runtime(target): who links the static library `target` with the compiler of another language, which
# does not know Fortran's libraries, links these too. CMake does so by itself only where Fortran is enabled in the
# folder of the program, which is not so in a project of C that has fuge as a subfolder, or finds it.
set(fortran_runtime ${CMAKE_Fortran_IMPLICIT_LINK_LIBRARIES})
list(REMOVE_ITEM fortran_runtime gcc gcc_s c)
list(REMOVE_DUPLICATES fortran_runtime)
set(fortran_runtime_dirs ${CMAKE_Fortran_IMPLICIT_LINK_DIRECTORIES})

function(fuge_link_fortran_runtime target)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "STATIC_LIBRARY")
    set(other_linker "$<NOT:$<LINK_LANGUAGE:Fortran>>")
    target_link_libraries(${target} INTERFACE "$<${other_linker}:${fortran_runtime}>")
    target_link_directories(${target} INTERFACE "$<${other_linker}:${fortran_runtime_dirs}>")
  endif()
endfunction()
