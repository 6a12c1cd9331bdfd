# SPDX-License-Identifier: MIT
# rebound_source_files(<list> <root> <folder>...): the source files in the root's folders, sorted, relative to the root.
function(rebound_source_files list root)
    set(all "")
    foreach(folder ${ARGN})
        foreach(kind h hpp inl cpp comp glsl in cmake)
            file(GLOB_RECURSE files RELATIVE ${root} ${root}/${folder}/*.${kind})
            list(APPEND all ${files})
        endforeach()
    endforeach()
    list(SORT all)
    set(${list} ${all} PARENT_SCOPE)
endfunction()
