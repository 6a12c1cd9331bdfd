# SPDX-License-Identifier: MIT
# What cmake --install lays down: headers, libraries, licence, and a package for find_package(rebound).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/rebound)
set(generated_folder ${CMAKE_CURRENT_BINARY_DIR}/package)

# rebound_install_library(<name> [<folder of headers>]): the target rebound_<name>, where it is built.
function(rebound_install_library name)
    if(NOT TARGET rebound_${name})
        return()
    endif()
    set_target_properties(rebound_${name} PROPERTIES EXPORT_NAME ${name})
    install(TARGETS rebound_${name} EXPORT rebound-targets)
    if(ARGN)
        install(DIRECTORY ${ARGN} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
    endif()
endfunction()

install(TARGETS rebound EXPORT rebound-targets)
install(DIRECTORY include/rebound DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
rebound_install_library(shaders)
foreach(backend cpu vulkan opengl embree mpi)
    rebound_install_library(${backend} backends/${backend}/include/rebound)
endforeach()
foreach(library bake input_check input_check_cpu input_check_shaders)
    rebound_install_library(${library})
endforeach()
install(EXPORT rebound-targets NAMESPACE rebound:: DESTINATION ${package_folder})

configure_package_config_file(cmake/rebound-config.cmake.in ${generated_folder}/rebound-config.cmake
    INSTALL_DESTINATION ${package_folder} PATH_VARS CMAKE_INSTALL_INCLUDEDIR)
# Before 1.0, minor versions may change the interface.
write_basic_package_version_file(${generated_folder}/rebound-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES
    ${generated_folder}/rebound-config.cmake
    ${generated_folder}/rebound-config-version.cmake
    cmake/rebound_add_kernels.cmake
    cmake/cpu_kernel.cpp.in
    cmake/cpu_kernel_table.cpp.in
    cmake/embed_gpu_kernel.cmake
    cmake/gpu_kernel_table.cpp.in
    DESTINATION ${package_folder})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
