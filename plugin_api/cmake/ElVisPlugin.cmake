# Functions for plugin projects.

# elvis_embed_text(TARGET HEADER NAMESPACE [FOLDER FOLDER] FILE...)
#
# Generates a C++ header that holds text files as string literals and adds its folder to the target's include path:
#   namespace NAMESPACE { inline constexpr struct { const char* name; const char* text; } files[] = {...}; }
# `name` is the file's path relative to FOLDER, by default the current source folder.
function(elvis_embed_text target header namespace)
  cmake_parse_arguments(ARG "" "FOLDER" "" ${ARGN})
  if(NOT ARG_FOLDER)
    set(ARG_FOLDER "${CMAKE_CURRENT_SOURCE_DIR}")
  endif()
  set(output "${CMAKE_CURRENT_BINARY_DIR}/embedded/${header}")
  set(inputs "")
  foreach(file ${ARG_UNPARSED_ARGUMENTS})
    list(APPEND inputs "${ARG_FOLDER}/${file}")
  endforeach()
  string(REPLACE ";" "|" names "${ARG_UNPARSED_ARGUMENTS}")
  add_custom_command(
    OUTPUT "${output}"
    COMMAND ${CMAKE_COMMAND} "-DOUTPUT=${output}" "-DFOLDER=${ARG_FOLDER}" "-DNAMES=${names}"
            "-DNAMESPACE=${namespace}" -P "${ELVIS_EMBED_SCRIPT}"
    DEPENDS ${inputs} "${ELVIS_EMBED_SCRIPT}"
    VERBATIM)
  target_sources(${target} PRIVATE "${output}")
  target_include_directories(${target} PRIVATE "${CMAKE_CURRENT_BINARY_DIR}/embedded")
endfunction()
set(ELVIS_EMBED_SCRIPT "${CMAKE_CURRENT_LIST_DIR}/embed_text.cmake" CACHE INTERNAL "Script behind elvis_embed_text")

# elvis_add_plugin(NAME SOURCES ... LINK ...)
#
# A plugin: a shared module that exports one symbol. Inside ElVis it is built and installed where the program looks for it;
# elsewhere set ELVIS_PLUGIN_OUTPUT_DIRECTORY or point $ELVIS_PLUGIN_PATH at its folder.
function(elvis_add_plugin name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} MODULE ${ARG_SOURCES})
  set_target_properties(${name} PROPERTIES PREFIX "" C_VISIBILITY_PRESET hidden CXX_VISIBILITY_PRESET hidden)
  if(NOT CMAKE_CXX_STANDARD)
    set_target_properties(${name} PROPERTIES CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON)
  endif()
  target_link_libraries(${name} PRIVATE ElVis::plugin_api ${ARG_LINK})
  # Nothing else is exported, static libraries linked in included: symbols that the C++ library declares unique in the process
  # would keep the plugin in memory after it has been unloaded.
  if(UNIX AND NOT APPLE)
    target_link_options(${name} PRIVATE "LINKER:--version-script=${ELVIS_PLUGIN_SYMBOLS}")
    set_property(TARGET ${name} APPEND PROPERTY LINK_DEPENDS "${ELVIS_PLUGIN_SYMBOLS}")
  endif()
  if(ELVIS_PLUGIN_OUTPUT_DIRECTORY)
    set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${ELVIS_PLUGIN_OUTPUT_DIRECTORY}")
  endif()
  if(ELVIS_PLUGIN_INSTALL_DIRECTORY)
    install(TARGETS ${name} LIBRARY DESTINATION "${ELVIS_PLUGIN_INSTALL_DIRECTORY}")
  endif()
endfunction()
set(ELVIS_PLUGIN_SYMBOLS "${CMAKE_CURRENT_LIST_DIR}/plugin.map" CACHE INTERNAL "What a plugin exports")
