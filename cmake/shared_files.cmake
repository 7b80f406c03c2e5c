# SPDX-License-Identifier: MIT
# sdre_install_shared(<directory> <component>): what an installed tool reads, in the source tree's places below <directory>, so
# that scenarios find their drives.
function(sdre_install_shared directory component)
    foreach(room firmware/config/drives firmware/config/specs host_tools/sil/scenarios host_tools/python/sdre_plot)
        get_filename_component(above "${room}" DIRECTORY)
        install(DIRECTORY "${PROJECT_SOURCE_DIR}/${room}" DESTINATION "${directory}/${above}" COMPONENT ${component}
            PATTERN __pycache__ EXCLUDE)
    endforeach()
endfunction()
