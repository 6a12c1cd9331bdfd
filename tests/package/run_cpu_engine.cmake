# SPDX-License-Identifier: MIT
# Builds the engine of cpu_engine/ with Rebound at REBOUND in its tree; with WITHOUT_GPU_TOOLS, on a machine that has no
# glslangValidator and no spirv-val. Nothing of Vulkan, of OpenGL and of the input check may be built, and a warning may
# not be an error.
cmake_minimum_required(VERSION 3.22)

function(run)
    execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    message("${output}")
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "${ARGV} failed: ${result}")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
file(COPY ${ENGINE}/ DESTINATION ${WORK}/engine)
file(MAKE_DIRECTORY ${WORK}/engine/third_party)
file(CREATE_LINK ${REBOUND} ${WORK}/engine/third_party/rebound SYMBOLIC)

set(options -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -D CMAKE_BUILD_TYPE=${CONFIG})
# One instruction set, hardly optimised, is enough to see what is built.
list(APPEND options -D REBOUND_ISAS=baseline -D REBOUND_KERNEL_OPTIMIZATION=-O1
    -D "CMAKE_CXX_FLAGS=-Wall -Wextra -include ${WORK}/engine/warning.h")
if(WITHOUT_GPU_TOOLS)
    list(APPEND options -D REBOUND_GLSLANG= -D REBOUND_SPIRV_VAL=)
endif()
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${WORK}/engine -B ${WORK}/build ${options})
if(WITHOUT_GPU_TOOLS)
    if(NOT output MATCHES "left out: glslangValidator or spirv-val was not found")
        message(FATAL_ERROR "configuring did not say what is left out")
    endif()
    return() # what is built is the same
endif()

run(${CMAKE_COMMAND} --build ${WORK}/build --config ${CONFIG})
if(NOT output MATCHES "unused parameter")
    message(FATAL_ERROR "the planted warning was not seen")
endif()
run(${WORK}/build/engine)
file(GLOB_RECURSE libraries RELATIVE ${WORK}/build ${WORK}/build/*.a)
if(NOT libraries MATCHES "^[^;]*librebound_cpu\\.a$")
    message(FATAL_ERROR "librebound_cpu.a alone was to be built, but these were: ${libraries}")
endif()
