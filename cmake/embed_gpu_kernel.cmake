# SPDX-License-Identifier: MIT
# Compiles KERNEL to SPIR-V and to expanded GLSL, checks both, and writes OUTPUT, a C++ file that holds them.
get_filename_component(folder ${OUTPUT} DIRECTORY)
set(base ${folder}/${ID})

function(run)
    execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "${output}")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()

set(include_line "#extension GL_GOOGLE_include_directive : require\n#include \"${NAME}.comp\"\n")

file(WRITE ${base}.vulkan.comp "#version 450\n${include_line}")
run(${GLSLANG} -V --target-env vulkan1.1 -I${INCLUDE} -I${FOLDER} -o ${base}.spv ${base}.vulkan.comp)
run(${SPIRV_VAL} --target-env vulkan1.1 ${base}.spv)

file(WRITE ${base}.opengl.comp "#version 430\n${include_line}")
run(${GLSLANG} -E -S comp -I${INCLUDE} -I${FOLDER} ${base}.opengl.comp)
string(REGEX REPLACE "#(line|version|extension)[^\n]*\n" "" glsl "${output}")
string(REGEX REPLACE "\n[ \t]*(\n[ \t]*)+" "\n" glsl "${glsl}")

set(feature_values "")
foreach(id RANGE 3)
    string(APPEND feature_values "#define REBOUND_FEATURE_${id} 0\n")
endforeach()
foreach(version "430" "310 es")
    string(REPLACE " " "" suffix "${version}")
    file(WRITE ${base}.${suffix}.comp "#version ${version}\n${feature_values}${glsl}")
    run(${GLSLANG} -S comp ${base}.${suffix}.comp)
endforeach()

file(READ ${base}.spv hex HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${hex}")
string(REGEX REPLACE "((0x[0-9a-f]+,){8})" "\\1\n    " words "${words}")
# What the kernel declares is read by C++, as for a CPU: nothing of it runs.
file(WRITE ${OUTPUT} "// Generated: ${NAME}.
#include \"rebound/kernel/declarations.h\"

namespace rebound::cpu::declarations {
namespace {
#include \"${FOLDER}/${NAME}.comp\"
#include \"rebound/kernel/kernel_info.h\"
} // namespace
static constexpr const KernelInfo& infoOf${ID} = kernelInfo;
} // namespace rebound::cpu::declarations

namespace rebound::shaders {
namespace {
constexpr uint32_t spirv[] = {
    ${words}
};
constexpr std::string_view glsl = R\"GLSL(${glsl})GLSL\";
}
extern const Shader ${ID};
const Shader ${ID} = {\"${NAME}\", spirv, glsl, cpu::declarations::infoOf${ID}};
} // namespace rebound::shaders
")
