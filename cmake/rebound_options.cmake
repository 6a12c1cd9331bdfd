# SPDX-License-Identifier: MIT
# Compile options of Rebound's own targets; nothing here reaches an engine that links them.

if(PROJECT_IS_TOP_LEVEL)
    find_program(REBOUND_CCACHE ccache)
    if(REBOUND_CCACHE)
        set(CMAKE_CXX_COMPILER_LAUNCHER ${REBOUND_CCACHE})
    endif()
    set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
    set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O1 -g")
endif()

function(rebound_target_options target)
    target_compile_features(${target} PUBLIC cxx_std_20)
    set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
    if(REBOUND_STRICT AND NOT MSVC)
        target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror)
    endif()
    if(REBOUND_SANITIZE)
        # Line numbers are what reports name; full debug information of instrumented templates takes twice as long.
        target_compile_options(${target} PRIVATE -fsanitize=${REBOUND_SANITIZE} -fno-sanitize-recover=all
                                                 -fno-omit-frame-pointer -g1)
        target_link_options(${target} PUBLIC -fsanitize=${REBOUND_SANITIZE})
    endif()
endfunction()

# For targets that are compiled for longer than they run: what takes their time is in other libraries.
function(rebound_optimise_little target)
    if(NOT MSVC)
        target_compile_options(${target} PRIVATE -O1)
    endif()
endfunction()

# For targets in which many files include a large header of another library. ccache keeps their objects where its own
# setting has sloppiness = pch_defines,time_macros.
function(rebound_precompile target)
    target_precompile_headers(${target} PRIVATE ${ARGN})
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options(${target} PRIVATE -fpch-preprocess) # ccache asks for it
    endif()
endfunction()
