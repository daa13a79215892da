# Installs the pages, the worked examples that they name, and the changelog. The tree of an installation is another than that of the
# sources, so links are written anew; a test follows all of them.
file(RELATIVE_PATH to_headers "/${CMAKE_INSTALL_DOCDIR}" "/${CMAKE_INSTALL_INCLUDEDIR}")

# Installs a page into `folder`, relative to that of the documentation.
function(install_page page folder)
  file(READ "${page}" text)
  string(REPLACE "](include/" "](${to_headers}/" text "${text}")
  string(REPLACE "](../plugins/" "](examples/" text "${text}")
  string(REPLACE "](../tests/fixtures" "](examples/c" text "${text}")
  string(REPLACE "](../CHANGELOG.md" "](CHANGELOG.md" text "${text}")
  string(REPLACE "](../core/scene/scenes.md" "](scenes.md" text "${text}")
  string(REPLACE "](../../plugin_api/" "](../../" text "${text}")
  get_filename_component(name "${page}" NAME)
  set(copy "${CMAKE_CURRENT_BINARY_DIR}/pages/${folder}/${name}")
  file(WRITE "${copy}" "${text}")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${page}")
  install(FILES "${copy}" DESTINATION "${CMAKE_INSTALL_DOCDIR}/${folder}" COMPONENT plugin_api)
endfunction()

foreach(page README.md glsl_interface.md reference.md stability.md tutorial.md)
  install_page("${CMAKE_CURRENT_SOURCE_DIR}/${page}" ".")
endforeach()
install(FILES interface_changes.txt ../CHANGELOG.md ../core/scene/scenes.md DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT plugin_api)
install(DIRECTORY abi DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT plugin_api)

foreach(example analytic cut_cells dubiner_dg elvis_dat lattice nurbs)
  set(sources "${CMAKE_CURRENT_SOURCE_DIR}/../plugins/${example}")
  install_page("${sources}/README.md" "examples/${example}")
  install(DIRECTORY "${sources}" DESTINATION "${CMAKE_INSTALL_DOCDIR}/examples" COMPONENT plugin_api PATTERN README.md EXCLUDE)
endforeach()
# Small plugins in C.
foreach(source cube.h descriptor.h good.c sampled.c tetrahedron.h world_source.c)
  install(FILES "${CMAKE_CURRENT_SOURCE_DIR}/../tests/fixtures/${source}" DESTINATION "${CMAKE_INSTALL_DOCDIR}/examples/c" COMPONENT plugin_api)
endforeach()
