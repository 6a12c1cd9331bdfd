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

# What the kernel declares, for the devices that check plans against it.
file(READ ${FOLDER}/${NAME}.comp text)
set(kinds none none none none none none none none none none none none none none none none)
set(formats r32f r32f r32f r32f r32f r32f r32f r32f r32f r32f r32f r32f r32f r32f r32f r32f)
set(counts 1 1 1 1)
function(replace_item list index value)
    list(REMOVE_AT ${list} ${index})
    list(INSERT ${list} ${index} ${value})
    set(${list} ${${list}} PARENT_SCOPE)
endfunction()
string(REGEX MATCHALL "RB_(TEXTURE|TEXTURE_OF_ANY_SIZE|INPUT|IMAGE|OUTPUT|BUFFER|CONSTANTS|FEATURE)\\([^)]*\\)" declarations "${text}")
foreach(declaration ${declarations})
    string(REGEX MATCH "^RB_([A-Z_]+)\\( *([0-9]+) *, *([A-Za-z0-9_]+) *,? *([A-Za-z0-9_]*) *\\)" matched "${declaration}")
    if(NOT matched)
        message(FATAL_ERROR "${NAME}: ${declaration} is not a declaration of a slot or a feature")
    endif()
    set(index ${CMAKE_MATCH_2})
    set(third "${CMAKE_MATCH_3}")
    set(fourth "${CMAKE_MATCH_4}")
    string(TOLOWER ${CMAKE_MATCH_1} kind)
    string(REPLACE "_of_any_size" "" kind ${kind})
    if(kind STREQUAL "feature")
        if(NOT fourth MATCHES "^[0-9]+$")
            string(REGEX MATCH "const int ${fourth} *= *([0-9]+)" matched "${glsl}")
            set(fourth ${CMAKE_MATCH_1})
        endif()
        replace_item(counts ${index} ${fourth})
    else()
        if(kind MATCHES "image|output")
            replace_item(formats ${index} ${third})
        endif()
        replace_item(kinds ${index} ${kind})
    endif()
endforeach()
list(TRANSFORM kinds PREPEND "BindingKind::")
list(JOIN kinds ", " kinds)
list(TRANSFORM formats PREPEND "Format::")
list(JOIN formats ", " formats)
list(JOIN counts ", " counts)

file(READ ${base}.spv hex HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${hex}")
string(REGEX REPLACE "((0x[0-9a-f]+,){8})" "\\1\n    " words "${words}")
file(WRITE ${OUTPUT} "// Generated: ${NAME}.
#include \"rebound/shaders.hpp\"

namespace rebound::shaders {
namespace {
constexpr uint32_t spirv[] = {
    ${words}
};
constexpr std::string_view glsl = R\"GLSL(${glsl})GLSL\";
}
extern const Shader ${ID};
const Shader ${ID} = {
    \"${NAME}\",
    spirv,
    glsl,
    {{${kinds}}, {${counts}}, {}},
    {${formats}},
};
} // namespace rebound::shaders
")
