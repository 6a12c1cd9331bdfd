# SPDX-License-Identifier: MIT
# Compile options of Rebound's own targets; nothing here reaches an engine that links them.

if(PROJECT_IS_TOP_LEVEL)
    find_program(REBOUND_CCACHE ccache)
    if(REBOUND_CCACHE)
        # So that it keeps objects that use a precompiled header.
        set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros
            ${REBOUND_CCACHE})
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

# Headers of the standard library and of GLM, which take half of the time that most files compile for, are compiled once
# for all targets of one kind and optimisation. Call it when a target has its options; not for kernels, in which GLM has
# other names (lanes_headers.h). Headers that are named beside are those of the target alone.
# An engine that vendors Rebound decides on such things itself.
set(rebound_common_headers <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <memory> <optional> <span>
    <string> <string_view> <vector> <glm/glm.hpp>)
function(rebound_precompile target)
    if(NOT PROJECT_IS_TOP_LEVEL)
        return()
    endif()
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options(${target} PRIVATE -fpch-preprocess) # ccache asks for it
        # GCC 12 warns of its own std::string (GCC bugs 105329 and 105651) unless its header is a system's, which it forgets
        # of precompiled ones. The sanitizers' tests look at what these warnings would.
        target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow
            -Wno-stringop-overread)
    endif()
    if(ARGN)
        target_precompile_headers(${target} PRIVATE ${rebound_common_headers} ${ARGN})
        return()
    endif()
    get_target_property(kind ${target} TYPE)
    if(kind STREQUAL "EXECUTABLE")
        set(owner rebound_precompiled_program)
    else()
        set(owner rebound_precompiled_library)
    endif()
    get_target_property(options ${target} COMPILE_OPTIONS)
    if("-O1" IN_LIST options)
        string(APPEND owner "_optimised_little")
    endif()
    rebound_add_precompiled(${owner} ${kind})
    target_precompile_headers(${target} REUSE_FROM ${owner})
endfunction()

# A target that has these headers and nothing else.
function(rebound_add_precompiled owner kind)
    if(TARGET ${owner})
        return()
    endif()
    set(source ${PROJECT_BINARY_DIR}/${owner}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "int main() {}\n")
    if(kind STREQUAL "EXECUTABLE")
        add_executable(${owner} EXCLUDE_FROM_ALL ${source})
    else()
        add_library(${owner} STATIC EXCLUDE_FROM_ALL ${source})
    endif()
    rebound_target_options(${owner})
    if(owner MATCHES "_optimised_little$")
        rebound_optimise_little(${owner})
    endif()
    target_link_libraries(${owner} PRIVATE glm::glm)
    rebound_precompile(${owner} <type_traits>)
endfunction()

# The same for targets of kernels for GPUs, which see what kernels declare.
function(rebound_precompile_declarations target)
    if(NOT PROJECT_IS_TOP_LEVEL)
        return()
    endif()
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options(${target} PRIVATE -fpch-preprocess)
    endif()
    if(TARGET rebound_shaders AND NOT target STREQUAL "rebound_shaders")
        target_precompile_headers(${target} REUSE_FROM rebound_shaders)
    else()
        target_precompile_headers(${target} PRIVATE <rebound/kernel/declarations.h>)
    endif()
endfunction()
