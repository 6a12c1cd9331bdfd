# SPDX-License-Identifier: MIT
# What cmake --install lays down: headers, libraries, licence, and a package for find_package(rebound).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/rebound)
set(generated_folder ${CMAKE_CURRENT_BINARY_DIR}/package)

set_target_properties(rebound_shaders PROPERTIES EXPORT_NAME shaders)
install(TARGETS rebound rebound_shaders EXPORT rebound-targets)
install(DIRECTORY include/rebound DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
if(REBOUND_BUILD_CPU)
    set_target_properties(rebound_cpu PROPERTIES EXPORT_NAME cpu)
    install(TARGETS rebound_cpu EXPORT rebound-targets)
    install(DIRECTORY backends/cpu/include/rebound DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endif()
if(REBOUND_BUILD_VULKAN)
    set_target_properties(rebound_vulkan PROPERTIES EXPORT_NAME vulkan)
    install(TARGETS rebound_vulkan EXPORT rebound-targets)
    install(DIRECTORY backends/vulkan/include/rebound DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endif()
if(REBOUND_BUILD_OPENGL)
    set_target_properties(rebound_opengl PROPERTIES EXPORT_NAME opengl)
    install(TARGETS rebound_opengl EXPORT rebound-targets)
    install(DIRECTORY backends/opengl/include/rebound DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endif()
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
