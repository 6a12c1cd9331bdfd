# SPDX-License-Identifier: MIT
# Writes HEADER: the text of SHADER, with what it includes from its own folder or from INCLUDES, as a constant NAME.
get_filename_component(folder ${SHADER} DIRECTORY)
file(READ ${SHADER} text)
while(text MATCHES "#include \"([^\"]+)\"\n")
    set(line "${CMAKE_MATCH_0}")
    set(file "${folder}/${CMAKE_MATCH_1}")
    if(NOT EXISTS ${file})
        set(file "${INCLUDES}/${CMAKE_MATCH_1}")
    endif()
    file(READ ${file} included)
    string(REPLACE "${line}" "${included}" text "${text}")
endwhile()
file(WRITE ${HEADER} "#pragma once\n\nstatic const char ${NAME}[] = R\"glsl(${text})glsl\";\n")
