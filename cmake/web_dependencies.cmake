# SPDX-License-Identifier: MIT
# Libraries of host_tools/web, all of headers alone. Emscripten has its own C library, so of the host's /usr/include it
# must see these directories and nothing else.
set(web_include "${PROJECT_BINARY_DIR}/include")
file(MAKE_DIRECTORY "${web_include}")
foreach(name CLI Eigen unsupported fmt nlohmann toml++)
    find_path(web_${name}_parent "${name}" PATHS /usr/include /usr/local/include PATH_SUFFIXES eigen3
        NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH REQUIRED)
    file(CREATE_LINK "${web_${name}_parent}/${name}" "${web_include}/${name}" SYMBOLIC)
endforeach()
foreach(name CLI11::CLI11 Eigen3::Eigen fmt::fmt nlohmann_json::nlohmann_json tomlplusplus::tomlplusplus)
    add_library(${name} INTERFACE IMPORTED)
    target_include_directories(${name} SYSTEM INTERFACE "${web_include}")
endforeach()
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)
set(SDRE_PYTHON "") # nothing is drawn there
