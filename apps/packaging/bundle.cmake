# What `cpack -G TXZ` packs: the program, its plugins, and what a machine may lack. See README.md beside this file.
if(NOT ELVIS_STATIC_LIBRARIES)
  return()
endif()

# The judge of pictures, for tests/gpu/run.
if(TARGET elvis_hunt)
  install(TARGETS elvis_hunt RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT bundle EXCLUDE_FROM_ALL)
endif()

# For windows; loaded when one is opened.
find_library(ELVIS_GLFW NAMES libglfw.so.3)
if(ELVIS_GLFW)
  file(REAL_PATH "${ELVIS_GLFW}" glfw)
  install(FILES "${glfw}" RENAME libglfw.so.3 DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT bundle EXCLUDE_FROM_ALL)
endif()

find_file(ELVIS_FONT DejaVuSans.ttf PATHS /usr/share/fonts PATH_SUFFIXES truetype/dejavu dejavu-sans-fonts dejavu TTF truetype)
if(ELVIS_FONT)
  install(FILES "${ELVIS_FONT}" DESTINATION "${CMAKE_INSTALL_DATADIR}/elvis/fonts" COMPONENT bundle EXCLUDE_FROM_ALL)
endif()

install(FILES LICENSE CHANGELOG.md DESTINATION . COMPONENT bundle EXCLUDE_FROM_ALL)
install(FILES apps/packaging/README.md DESTINATION . COMPONENT bundle EXCLUDE_FROM_ALL)
install(PROGRAMS tests/gpu/run DESTINATION tests/gpu COMPONENT bundle EXCLUDE_FROM_ALL)
install(DIRECTORY tests/gpu/scenes DESTINATION tests/gpu COMPONENT bundle EXCLUDE_FROM_ALL)
install(FILES tests/data/elvis/bulletH1P2.dat tests/data/elvis/LICENSE.ElVis DESTINATION tests/data/elvis COMPONENT bundle EXCLUDE_FROM_ALL)

# What their licences ask for, where Debian keeps them.
foreach(package fonts-dejavu-core glslang-dev libaec-dev libboost1.74-dev libbrotli-dev libdeflate-dev libeigen3-dev libfmt-dev libfreetype-dev libglfw3
                libhdf5-dev libimgui-dev liblz4-dev libpng-dev libpugixml-dev libspdlog-dev libstdc++-12-dev libsz2 libturbojpeg0-dev nlohmann-json3-dev
                libcli11-dev spirv-tools zlib1g-dev)
  install(FILES "/usr/share/doc/${package}/copyright" RENAME "${package}" DESTINATION "${CMAKE_INSTALL_DOCDIR}/licenses"
          COMPONENT bundle EXCLUDE_FROM_ALL OPTIONAL)
endforeach()
# Tables of points in the plugin.
install(FILES plugins/pyfr/LICENSE.PyFR RENAME PyFR DESTINATION "${CMAKE_INSTALL_DOCDIR}/licenses" COMPONENT bundle EXCLUDE_FROM_ALL)

set(CPACK_GENERATOR TXZ)
set(CPACK_PACKAGE_VENDOR ElVis)
set(CPACK_PACKAGE_CHECKSUM SHA256)
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
string(TOLOWER "${CMAKE_SYSTEM_NAME}" system)
set(CPACK_PACKAGE_FILE_NAME "elvis-${PROJECT_VERSION}-${system}-${CMAKE_SYSTEM_PROCESSOR}")
set(CPACK_STRIP_FILES TRUE)
set(CPACK_THREADS 0) # All cores.
# The program and its plugins are of no named component.
set(CPACK_COMPONENTS_ALL Unspecified bundle)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_COMPONENT_INCLUDE_TOPLEVEL_DIRECTORY ON)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
include(CPack)
