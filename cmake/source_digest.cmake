# SPDX-License-Identifier: MIT
# Writes OUTPUT, a C++ file that defines the string_view NAME of NAMESPACE: a hash of the names and the text of all source
# files in ROOT's FOLDERS (with commas between them), and of TOOLS, what they are compiled with.
include(${CMAKE_CURRENT_LIST_DIR}/source_files.cmake)
string(REPLACE "," ";" folders "${FOLDERS}")
rebound_source_files(files ${ROOT} ${folders})
if(NOT files)
    message(FATAL_ERROR "no source files in ${FOLDERS}")
endif()
set(text "${TOOLS}\n")
foreach(file ${files})
    file(SHA256 ${ROOT}/${file} hash)
    string(APPEND text "${file} ${hash}\n")
endforeach()
string(SHA256 digest "${text}")
file(WRITE ${OUTPUT} "// Generated.
#include <string_view>

namespace ${NAMESPACE} {
extern const std::string_view ${NAME};
const std::string_view ${NAME} = \"${digest}\";
} // namespace ${NAMESPACE}
")
