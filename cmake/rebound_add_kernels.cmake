# SPDX-License-Identifier: MIT
# rebound_add_kernels(<target> [CPU] TABLE <function> FOLDER <folder> KERNELS <name>...)
#
# Adds the kernels <folder>/<name>.comp to <target>, and a function that lists them:
# without CPU, std::span<const Shader* const> rebound::<function>(), each kernel as SPIR-V (checked by spirv-val) and as
# expanded GLSL (checked as OpenGL 4.3 and as OpenGL ES 3.1);
# with CPU, std::span<const KernelEntry* const> rebound::cpu::<function>(Isa), each kernel compiled for every instruction
# set of the processor family.

# The global property REBOUND_INCLUDE_FOLDER says where rebound/kernel/kernel.h lies.

set(REBOUND_ISAS "" CACHE STRING "Instruction sets to compile CPU kernels for; empty: all of the processor family")

# Instruction sets of CPU kernels (isas), the compiler options of all and of each. NaN matters to kernels, so no
# -ffast-math.
macro(rebound_kernel_options)
    if(NOT REBOUND_KERNEL_OPTIMIZATION)
        # -O2 compiles up to three times as fast, and upsampling then takes twice as long.
        set(REBOUND_KERNEL_OPTIMIZATION -O3)
    endif()
    set(kernel_options ${REBOUND_KERNEL_OPTIMIZATION} -fno-math-errno -fno-trapping-math -ffp-contract=fast)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        # GCC 12 takes the deliberately undefined operands of its own AVX-512 intrinsics for a mistake (GCC bug 105593).
        list(APPEND kernel_options -Wno-maybe-uninitialized -Wno-uninitialized)
    endif()
    if(REBOUND_SANITIZE)
        # With every arithmetic operation checked and described, and every temporary poisoned at the end of its scope,
        # unrolled kernels would take minutes to compile; their accesses of images and buffers are what can go wrong.
        list(TRANSFORM kernel_options REPLACE "-O3" "-O1")
        list(APPEND kernel_options -g0 -fno-sanitize=undefined -fno-sanitize-address-use-after-scope)
    endif()
    if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64|amd64")
        set(isas scalar baseline avx2 avx512)
        set(isa_options_avx2 -mavx2 -mfma -mf16c)
        set(isa_options_avx512 -mavx2 -mfma -mf16c -mavx512f -mavx512cd -mavx512dq -mavx512bw -mavx512vl)
    elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
        set(isas scalar baseline)
    else()
        set(isas scalar)
    endif()
    foreach(isa ${REBOUND_ISAS})
        if(NOT isa IN_LIST isas)
            message(FATAL_ERROR "REBOUND_ISAS holds ${isa}; some of ${isas} were expected")
        endif()
    endforeach()
    if(REBOUND_ISAS)
        set(isas ${REBOUND_ISAS})
    endif()
endmacro()

function(rebound_add_kernels target)
    cmake_parse_arguments(arg "CPU" "TABLE;FOLDER" "KERNELS" ${ARGN})
    if(arg_CPU)
        rebound_add_cpu_kernels(${target} ${arg_TABLE} ${arg_FOLDER} "${arg_KERNELS}")
    else()
        rebound_add_gpu_kernels(${target} ${arg_TABLE} ${arg_FOLDER} "${arg_KERNELS}")
    endif()
endfunction()

# Writes a file that compiles a kernel for one instruction set.
function(rebound_write_cpu_kernel output kernel_file kernel_name isa)
    string(MAKE_C_IDENTIFIER ${kernel_name} kernel_id)
    if(isa STREQUAL "scalar")
        set(scalar_definition "#define REBOUND_SCALAR_LANES")
    else()
        set(scalar_definition "")
    endif()
    configure_file(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/cpu_kernel.cpp.in ${output} @ONLY)
endfunction()

function(rebound_add_cpu_kernels target table_function folder kernels)
    rebound_kernel_options()
    find_package(xsimd REQUIRED)
    # Headers alone: Debian's target would have every program link xtl.
    get_target_property(xsimd_include xsimd INTERFACE_INCLUDE_DIRECTORIES)
    target_include_directories(${target} SYSTEM PRIVATE ${xsimd_include})
    set(tables "")
    set(declarations "")
    foreach(isa ${isas})
        set(entries "")
        foreach(kernel_name ${kernels})
            string(MAKE_C_IDENTIFIER ${kernel_name} kernel_id)
            set(kernel_file ${folder}/${kernel_name}.comp)
            set(generated ${CMAKE_CURRENT_BINARY_DIR}/kernels/${kernel_id}_${isa}.cpp)
            rebound_write_cpu_kernel(${generated} ${kernel_file} ${kernel_name} ${isa})
            set_source_files_properties(${generated} PROPERTIES
                COMPILE_OPTIONS "${kernel_options};${isa_options_${isa}}"
                SKIP_PRECOMPILE_HEADERS ON
                OBJECT_DEPENDS ${kernel_file})
            target_sources(${target} PRIVATE ${generated})
            string(APPEND declarations "namespace ${isa} { extern const KernelEntry ${kernel_id}; }\n")
            string(APPEND entries "    &${isa}::${kernel_id},\n")
        endforeach()
        string(APPEND tables "constexpr const KernelEntry* ${isa}Kernels[] = {\n${entries}};\n")
    endforeach()
    set(lookups "")
    foreach(isa ${isas})
        string(APPEND lookups "    if (isa == Isa::${isa}) return ${isa}Kernels;\n")
    endforeach()
    set(table ${CMAKE_CURRENT_BINARY_DIR}/kernels/${target}_cpu_table.cpp)
    configure_file(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/cpu_kernel_table.cpp.in ${table} @ONLY)
    set_source_files_properties(${table} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
    target_sources(${target} PRIVATE ${table})
endfunction()

function(rebound_add_gpu_kernels target table_function folder kernels)
    find_program(REBOUND_GLSLANG glslangValidator REQUIRED)
    find_program(REBOUND_SPIRV_VAL spirv-val REQUIRED)
    get_property(include_folder GLOBAL PROPERTY REBOUND_INCLUDE_FOLDER)
    file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${include_folder}/rebound/*.h)
    set(declarations "")
    set(entries "")
    foreach(kernel_name ${kernels})
        string(MAKE_C_IDENTIFIER ${kernel_name} kernel_id)
        set(generated ${CMAKE_CURRENT_BINARY_DIR}/kernels/${kernel_id}_gpu.cpp)
        add_custom_command(OUTPUT ${generated}
            COMMAND ${CMAKE_COMMAND} -D GLSLANG=${REBOUND_GLSLANG} -D SPIRV_VAL=${REBOUND_SPIRV_VAL}
                -D FOLDER=${folder} -D NAME=${kernel_name} -D ID=${kernel_id}
                -D INCLUDE=${include_folder} -D OUTPUT=${generated}
                -P ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/embed_gpu_kernel.cmake
            DEPENDS ${folder}/${kernel_name}.comp ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/embed_gpu_kernel.cmake
                ${headers}
            COMMENT "Compiling ${kernel_name} to SPIR-V and GLSL" VERBATIM)
        target_sources(${target} PRIVATE ${generated})
        string(APPEND declarations "extern const Shader ${kernel_id};\n")
        string(APPEND entries "    &shaders::${kernel_id},\n")
    endforeach()
    set(table ${CMAKE_CURRENT_BINARY_DIR}/kernels/${target}_gpu_table.cpp)
    configure_file(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/gpu_kernel_table.cpp.in ${table} @ONLY)
    set_source_files_properties(${table} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
    target_sources(${target} PRIVATE ${table})
endfunction()
