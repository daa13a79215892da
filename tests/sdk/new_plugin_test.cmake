# Installs ElVis into an empty folder, writes a new plugin with the installed program, and does what that program says next.
#   -DBUILD=build tree (everything built) -DWORK=folder to work in -DKIND=runtime|converter
include("${CMAKE_CURRENT_LIST_DIR}/../support/run.cmake")

file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")
run(${CMAKE_COMMAND} --install "${BUILD}" --prefix "${WORK}/prefix")

# Plugins of the user who runs the tests are not looked at.
set(ENV{HOME} "${WORK}")
unset(ENV{XDG_DATA_HOME})
unset(ENV{ELVIS_PLUGIN_PATH})

run("${WORK}/prefix/bin/elvis" new-plugin my_solver --kind ${KIND})
if(NOT output MATCHES "cd my_solver && (CMAKE_PREFIX_PATH=[^ ]*) cmake --workflow --preset default")
  message(FATAL_ERROR "new-plugin does not say how to go on:\n${output}")
endif()
set(variable "${CMAKE_MATCH_1}")
run(${CMAKE_COMMAND} -E chdir my_solver ${CMAKE_COMMAND} -E env "${variable}" ${CMAKE_COMMAND} --workflow --preset default)
foreach(test conformance picture)
  if(NOT output MATCHES "${test} \\.+ +Passed")
    message(FATAL_ERROR "the test '${test}' of the new plugin was not run:\n${output}")
  endif()
endforeach()
if(NOT EXISTS "${WORK}/my_solver/build/picture.png")
  message(FATAL_ERROR "there is no picture")
endif()

# An existing folder is left alone.
execute_process(COMMAND "${WORK}/prefix/bin/elvis" new-plugin my_solver WORKING_DIRECTORY "${WORK}" RESULT_VARIABLE result
                OUTPUT_QUIET ERROR_VARIABLE output)
if(result EQUAL 0 OR NOT output MATCHES "not empty")
  message(FATAL_ERROR "new-plugin writes into a folder that is not empty: ${output}")
endif()

# A number from inside the snippet is shown, without building the plugin again.
if(KIND STREQUAL "runtime")
  file(READ "${WORK}/my_solver/src/snippet.glsl" original)
  string(REPLACE "return value / elvis_real(8);" "elvis_debug(xi.x * xi.y);\n    return value / elvis_real(8);" text "${original}")
  file(WRITE "${WORK}/my_solver/src/snippet.glsl" "${text}")
  run(${CMAKE_COMMAND} -E chdir my_solver "${WORK}/prefix/bin/elvis" compile-snippet src/snippet.glsl --plugin build/my_solver.so
      --volume sample/twist.mesh --at 3,0.25,0.5,0)
  if(NOT output MATCHES "elvis_field_value of temperature = .*elvis_debug 0: 0.125")
    message(FATAL_ERROR "elvis_debug is not shown:\n${output}")
  endif()
  file(WRITE "${WORK}/my_solver/src/snippet.glsl" "${original}")
endif()

# A mistake in the snippet is reported with its file and line.
if(KIND STREQUAL "runtime")
  file(READ "${WORK}/my_solver/src/snippet.glsl" text)
  string(REPLACE "return value / elvis_real(8);" "return value / elvis_rael(8);" text "${text}")
  file(WRITE "${WORK}/my_solver/src/snippet.glsl" "${text}")
  foreach(arguments "" "--plugin;build/my_solver.so;--volume;sample/twist.mesh")
    execute_process(COMMAND "${WORK}/prefix/bin/elvis" compile-snippet src/snippet.glsl ${arguments} WORKING_DIRECTORY "${WORK}/my_solver"
                    RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE output)
    if(result EQUAL 0 OR NOT output MATCHES "snippet.glsl:39: 'elvis_rael'.*nearest is elvis_real")
      message(FATAL_ERROR "compile-snippet ${arguments} does not name the place of the mistake:\n${output}")
    endif()
  endforeach()
endif()
