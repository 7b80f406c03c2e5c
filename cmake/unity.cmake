# SPDX-License-Identifier: MIT
# Target `unity`, the C test framework. Taken from, in this order: -DUNITY_ROOT=<dir>; the copy
# ./dev puts in build/unity, checked against unity.sha256; the upstream release, by commit.
set(UNITY_ROOT "" CACHE PATH "Your copy of Unity (empty: build/unity, or download)")

set(unity_prepared "${PROJECT_SOURCE_DIR}/build/unity")
set(unity_files unity.c unity.h unity_internals.h)

if(UNITY_ROOT)
    find_path(unity_dir unity.c PATHS "${UNITY_ROOT}" "${UNITY_ROOT}/src"
        NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH NO_CACHE)
    foreach(file IN LISTS unity_files)
        if(NOT EXISTS "${unity_dir}/${file}")
            set(refused "${UNITY_ROOT}")
            unset(UNITY_ROOT CACHE)
            message(FATAL_ERROR "no ${file} in UNITY_ROOT=${refused} or its src/")
        endif()
    endforeach()
elseif(EXISTS "${unity_prepared}")
    set(unity_dir "${unity_prepared}")
    file(STRINGS "${CMAKE_CURRENT_LIST_DIR}/unity.sha256" unity_known)
    foreach(file IN LISTS unity_files)
        set(digest missing)
        if(EXISTS "${unity_dir}/${file}")
            file(SHA256 "${unity_dir}/${file}" digest)
        endif()
        if(NOT "${digest}  ${file}" IN_LIST unity_known)
            message(FATAL_ERROR "${unity_dir}/${file} is not a known copy of Unity: "
                "delete that directory, or pass -DUNITY_ROOT=<dir>")
        endif()
    endforeach()
else()
    message(NOTICE "Unity: cloning the upstream release (use -DUNITY_ROOT=<dir> if this fails)")
    include(FetchContent)
    FetchContent_Declare(unity
        GIT_REPOSITORY https://github.com/ThrowTheSwitch/Unity.git
        GIT_TAG cbcd08fa7de711053a3deec6339ee89cad5d2697 # v2.6.1
        SOURCE_SUBDIR sources-only) # no such directory: its own CMakeLists.txt is not used
    FetchContent_MakeAvailable(unity)
    set(unity_dir "${unity_SOURCE_DIR}/src")
endif()
message(STATUS "Unity: ${unity_dir}")

add_library(unity STATIC "${unity_dir}/unity.c")
target_include_directories(unity SYSTEM PUBLIC "${unity_dir}")
target_compile_definitions(unity PUBLIC UNITY_INCLUDE_DOUBLE)
target_link_libraries(unity PRIVATE sdre_sanitizers)
