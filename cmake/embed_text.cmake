# SPDX-License-Identifier: MIT
# Writes OUTPUT, a C++ file that defines the string_view NAME of NAMESPACE with the text of INPUT.
file(READ ${INPUT} text HEX)
string(LENGTH "${text}" digits)
math(EXPR bytes "${digits} / 2")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" text "${text}")
set(line "................................................................")
string(REGEX REPLACE "(${line})" "\\1\"\n    \"" text "${text}")
file(WRITE ${OUTPUT} "// Generated.
#include <string_view>

namespace ${NAMESPACE} {
extern const std::string_view ${NAME};
const std::string_view ${NAME}(
    \"${text}\",
    ${bytes});
} // namespace ${NAMESPACE}
")
