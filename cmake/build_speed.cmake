# SPDX-License-Identifier: MIT
# ccache, and a faster linker for the many test programs, where they are installed. The build result
# is the same without them.
if(CMAKE_SYSTEM_NAME STREQUAL "Generic" OR EMSCRIPTEN)
    return()
endif()

# ccache takes a unit with precompiled headers only when told so. A launcher of the user's stays.
find_program(CCACHE ccache)
mark_as_advanced(CCACHE)
foreach(language C CXX)
    if(CCACHE AND NOT CMAKE_${language}_COMPILER_LAUNCHER)
        set(CMAKE_${language}_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env
            CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_ctime,include_file_mtime "${CCACHE}")
    endif()
endforeach()

include(CheckLinkerFlag)
foreach(linker mold lld gold)
    check_linker_flag(C -fuse-ld=${linker} sdre_has_${linker})
    if(sdre_has_${linker})
        add_link_options(-fuse-ld=${linker})
        break()
    endif()
endforeach()
