# SPDX-License-Identifier: MIT
# The image of the stm32g431 for the 390 W motor before stage_300v.toml.
#
#     cmake -D GAINS=sdre-gains -D OUT=DIR [-D VALUES=KEY=NUMBER,..] -P stage_image.cmake
#
# It writes DIR/ipmsm_390w.toml, with these values, and DIR/sdre_stm32g431.elf.
get_filename_component(source "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

file(READ "${source}/firmware/config/drives/ipmsm_390w.toml" drive)
string(REPLACE "\"board_390w\"" "\"stage_300v\"" drive "${drive}")
string(REPLACE "," ";" VALUES "${VALUES}")
foreach(pair IN LISTS VALUES)
    string(REPLACE "=" ";" pair "${pair}")
    list(GET pair 0 key)
    list(GET pair 1 number)
    string(REGEX REPLACE "\n(${key} *=) [0-9.e-]+" "\n\\1 ${number}" drive "${drive}")
endforeach()
file(WRITE "${OUT}/ipmsm_390w.toml" "${drive}")
file(COPY "${CMAKE_CURRENT_LIST_DIR}/stage_300v.toml" DESTINATION "${OUT}")

foreach(command
    "${GAINS};generate;${OUT}/ipmsm_390w.toml;--out;${OUT}/tables"
    "${CMAKE_COMMAND};--preset;stm32g431-release;-B;${OUT}/build;-D;SDRE_TABLES=${OUT}/tables"
    "${CMAKE_COMMAND};--build;${OUT}/build;--target;sdre_stm32g431")
    execute_process(COMMAND ${command} WORKING_DIRECTORY "${source}" RESULT_VARIABLE failed
        OUTPUT_VARIABLE text ERROR_VARIABLE text)
    if(failed)
        message(FATAL_ERROR "${text}")
    endif()
endforeach()
file(COPY "${OUT}/build/bin/sdre_stm32g431.elf" DESTINATION "${OUT}")
