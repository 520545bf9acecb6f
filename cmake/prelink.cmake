# Joining objects to one in which all names but those that begin with glint_ are local, so that a static
# library takes no other name from the programs it is linked into. With the address sanitizer, what it
# is told of fonts (output/picture.c) keeps its names too: it is found by them.

# GLINT_CAN_PRELINK: GNU ld or a linker that knows its options, and objcopy. Not with link-time
# optimisation: its objects hold no code yet. Sections that C++ shares between objects (COMDAT groups)
# must become plain ones: a linker would take those of another object in their place, where names of
# ours are not known.
include(CheckLinkerFlag)
check_linker_flag(C "LINKER:--force-group-allocation" GLINT_LINKER_FORCES_GROUPS)
set(GLINT_CAN_PRELINK OFF)
if(GLINT_LINKER_FORCES_GROUPS AND CMAKE_OBJCOPY AND NOT CMAKE_INTERPROCEDURAL_OPTIMIZATION
   AND NOT "${CMAKE_C_FLAGS} ${CMAKE_CXX_FLAGS}" MATCHES "-flto")
    set(GLINT_CAN_PRELINK ON)
else()
    message(STATUS "A static libglint shows its inner names: no linker and objcopy that could hide them")
endif()

# Makes `object` of a list of objects (generator expressions allowed).
function(glint_prelink object objects)
    separate_arguments(flags NATIVE_COMMAND "${CMAKE_C_FLAGS}")
    add_custom_command(OUTPUT ${object}
        COMMAND ${CMAKE_C_COMPILER} ${flags} -r -nostdlib -Wl,--force-group-allocation
            -o ${object} ${objects}
        COMMAND ${CMAKE_OBJCOPY} --wildcard --keep-global-symbol=glint_*
            --keep-global-symbol=__lsan_default_* ${object}
        DEPENDS ${objects} COMMAND_EXPAND_LISTS VERBATIM
        COMMENT "Joining the objects of libglint")
    set_source_files_properties(${object} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
endfunction()
