# SPDX-License-Identifier: MIT
# Libraries of the host tools; imported targets, so their headers count as system headers.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(CLI11 REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(NLopt REQUIRED)

find_package(tomlplusplus QUIET)
if(NOT TARGET tomlplusplus::tomlplusplus)
    find_package(PkgConfig REQUIRED)
    pkg_check_modules(tomlplusplus REQUIRED IMPORTED_TARGET tomlplusplus)
    add_library(tomlplusplus::tomlplusplus ALIAS PkgConfig::tomlplusplus)
endif()

if(SDRE_BUILD_TESTS)
    find_package(GTest REQUIRED)
    find_package(Threads REQUIRED)
    find_package(PkgConfig REQUIRED)
    pkg_check_modules(libmodbus REQUIRED IMPORTED_TARGET libmodbus)
endif()

# SDRE_PYTHON: the interpreter sdre-sil calls to draw. The system's own comes first, because
# matplotlib from the package manager is visible to that one only. Empty if there is none.
function(sdre_find_python result)
    if(SDRE_PYTHON)
        set(candidates "${SDRE_PYTHON}")
    else()
        set(candidates /usr/bin/python3 python3)
    endif()
    foreach(candidate IN LISTS candidates)
        execute_process(COMMAND "${candidate}" -c "import matplotlib"
            RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
        if(status EQUAL 0)
            set(${result} "${candidate}" PARENT_SCOPE)
            return()
        endif()
    endforeach()
    if(SDRE_PYTHON)
        unset(SDRE_PYTHON CACHE)
        message(FATAL_ERROR "SDRE_PYTHON=${candidates}: cannot import matplotlib")
    endif()
    message(NOTICE "no Python with matplotlib found: sdre-sil draws no plots") # it says so when asked to
    set(${result} "" PARENT_SCOPE)
endfunction()
sdre_find_python(SDRE_PYTHON)
