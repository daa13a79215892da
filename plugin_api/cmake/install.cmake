# Installs the package ElVis: find_package(ElVis) gives ElVis::plugin_api, elvis_add_plugin and elvis_embed_text, and, where HDF5 is
# found, ElVis::native. Two components, so that plugin authors need not build the library: `plugin_api` and `native`.
include(CMakePackageConfigHelpers)

set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/ElVis")

install(DIRECTORY include/elvis DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT plugin_api)
include("${CMAKE_CURRENT_LIST_DIR}/install_pages.cmake")
install(DIRECTORY tutorial DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT plugin_api)
install(TARGETS elvis_plugin_api EXPORT ElVisPluginApi COMPONENT plugin_api)
install(EXPORT ElVisPluginApi NAMESPACE ElVis:: DESTINATION "${package_folder}" COMPONENT plugin_api)

install(DIRECTORY native/include/elvis DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT native)
install(TARGETS elvis_native EXPORT ElVisNative ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT native)
install(EXPORT ElVisNative NAMESPACE ElVis:: DESTINATION "${package_folder}" COMPONENT native)

configure_package_config_file(cmake/ElVisConfig.cmake.in "${CMAKE_CURRENT_BINARY_DIR}/ElVisConfig.cmake"
                              INSTALL_DESTINATION "${package_folder}" PATH_VARS CMAKE_INSTALL_BINDIR CMAKE_INSTALL_DATADIR)
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/ElVisConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/ElVisConfig.cmake" "${CMAKE_CURRENT_BINARY_DIR}/ElVisConfigVersion.cmake"
              cmake/ElVisPlugin.cmake cmake/embed_text.cmake cmake/plugin.map
        DESTINATION "${package_folder}" COMPONENT plugin_api)
