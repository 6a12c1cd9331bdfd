# SPDX-License-Identifier: MIT
# rebound_add_source_digest(<target> NAME <name> NAMESPACE <namespace> FOLDERS <folder>... [TOOLS <text>])
#
# Adds to the target the string_view <namespace>::<name>, a hash of the text of all source files in those folders of the
# project, and of <text>: what is kept in files under it is never taken for the result of other code.
include(${CMAKE_CURRENT_LIST_DIR}/source_files.cmake)

function(rebound_add_source_digest target)
    cmake_parse_arguments(arg "" "NAME;NAMESPACE;TOOLS" "FOLDERS" ${ARGN})
    rebound_source_files(files ${PROJECT_SOURCE_DIR} ${arg_FOLDERS})
    list(TRANSFORM files PREPEND ${PROJECT_SOURCE_DIR}/)
    list(JOIN arg_FOLDERS "," folders)
    set(script ${PROJECT_SOURCE_DIR}/cmake/source_digest.cmake)
    set(output ${CMAKE_CURRENT_BINARY_DIR}/${arg_NAME}.cpp)
    add_custom_command(OUTPUT ${output}
        COMMAND ${CMAKE_COMMAND} -D ROOT=${PROJECT_SOURCE_DIR} -D FOLDERS=${folders} -D NAME=${arg_NAME}
            -D NAMESPACE=${arg_NAMESPACE} "-DTOOLS=${arg_TOOLS}" -D OUTPUT=${output} -P ${script}
        DEPENDS ${files} ${script}
        COMMENT "Hashing the text of ${folders}" VERBATIM)
    set_source_files_properties(${output} PROPERTIES SKIP_PRECOMPILE_HEADERS ON) # reading them takes longer
    target_sources(${target} PRIVATE ${output})
endfunction()
