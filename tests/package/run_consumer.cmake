# SPDX-License-Identifier: MIT
# Builds CONSUMER outside the tree that BUILD was built from, with find_package or add_subdirectory, and runs it.
cmake_minimum_required(VERSION 3.22)

function(run)
    execute_process(COMMAND ${ARGV} RESULT_VARIABLE result)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "${ARGV} failed: ${result}")
    endif()
endfunction()

set(options -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -D CMAKE_BUILD_TYPE=${CONFIG})
if(WAY STREQUAL "find_package")
    set(prefix ${WORK}/installed)
    file(REMOVE_RECURSE ${prefix})
    run(${CMAKE_COMMAND} --install ${BUILD} --config ${CONFIG} --prefix ${prefix})
    list(APPEND options -D CMAKE_PREFIX_PATH=${prefix})
else()
    # One instruction set, hardly optimised, is enough to see that the build works.
    list(APPEND options -D REBOUND_SOURCE=${REBOUND} -D REBOUND_ISAS=baseline -D REBOUND_KERNEL_OPTIMIZATION=-O1)
endif()

run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${CONSUMER} -B ${WORK}/${WAY} ${options})
run(${CMAKE_COMMAND} --build ${WORK}/${WAY} --config ${CONFIG} --target all)
run(${WORK}/${WAY}/consumer)
if(EXISTS ${WORK}/${WAY}/consumer_opengl)
    run(${WORK}/${WAY}/consumer_opengl)
endif()
