# SPDX-License-Identifier: MIT
# Writes OUTPUT, a C++ file that defines the string_view NAME of NAMESPACE with the text of INPUT, character by
# character: compilers need not take string literals of more than 65536.
file(READ ${INPUT} text HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," text "${text}")
set(line ".......")
string(REGEX REPLACE "(${line}${line}${line}${line}${line}${line}${line}${line}${line}${line}${line}${line})" "\\1\n    "
    text "${text}")
file(WRITE ${OUTPUT} "// Generated.
#include <string_view>

namespace ${NAMESPACE} {
namespace {
constexpr char characters[] = {
    ${text}
};
} // namespace
extern const std::string_view ${NAME};
const std::string_view ${NAME}(characters, sizeof characters);
} // namespace ${NAMESPACE}
")
