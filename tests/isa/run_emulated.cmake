# SPDX-License-Identifier: MIT
# Runs the command behind -- on an emulated PROCESSOR: its exit status or signal must be STATUS, and what it writes must
# match OUTPUT.
cmake_minimum_required(VERSION 3.22)
find_program(QEMU qemu-x86_64)
if(NOT QEMU)
    message("skipped: qemu-x86_64 (Debian package qemu-user) is not installed")
    return()
endif()

set(command "")
set(is_command FALSE)
foreach(i RANGE ${CMAKE_ARGC})
    if(is_command)
        list(APPEND command "${CMAKE_ARGV${i}}")
    elseif("${CMAKE_ARGV${i}}" STREQUAL "--")
        set(is_command TRUE)
    endif()
endforeach()

execute_process(COMMAND ${QEMU} -cpu ${PROCESSOR} ${command}
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT status STREQUAL STATUS OR NOT output MATCHES "${OUTPUT}")
    message("${output}")
    message(FATAL_ERROR "exit status \"${status}\", \"${STATUS}\" expected; output to match \"${OUTPUT}\"")
endif()
message("${output}")
