# Installs the package into an empty folder, builds the plugins of package/ with it, and lets the program load them.
#   -DBUILD=build tree -DSOURCE=this folder -DWORK=folder to work in -DELVIS=the program -DWITH_NATIVE=ON|OFF -DGENERATOR=CMake generator
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed: ${command}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${WORK}")
run(${CMAKE_COMMAND} --install "${BUILD}" --prefix "${WORK}/prefix" --component plugin_api)
if(WITH_NATIVE)
  run(${CMAKE_COMMAND} --install "${BUILD}" --prefix "${WORK}/prefix" --component native)
endif()
run(${CMAKE_COMMAND} -G "${GENERATOR}" -S "${SOURCE}/package" -B "${WORK}/build" "-DCMAKE_PREFIX_PATH=${WORK}/prefix"
    -DWITH_NATIVE=${WITH_NATIVE} "-DCMAKE_C_FLAGS=-Wall -Wextra -Wpedantic -Werror"
    "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wpedantic -Werror ${CXX_FLAGS}")
run(${CMAKE_COMMAND} --build "${WORK}/build")
if(WITH_NATIVE)
  run("${WORK}/build/native_user")
endif()

# Where others' plugins may lie is not looked at.
run(${CMAKE_COMMAND} -E env "HOME=${WORK}" --unset=XDG_DATA_HOME "ELVIS_PLUGIN_PATH=${WORK}/build" "${ELVIS}" plugins --json)
string(JSON found GET "${output}" plugins)
string(JSON refused GET "${output}" refused)
foreach(id org.example.outside org.example.outside-in-c)
  if(NOT found MATCHES "\"${id}\"")
    message(FATAL_ERROR "${id} is not among the plugins found:\n${output}")
  endif()
endforeach()
if(NOT refused MATCHES "^\\[ *\\]$")
  message(FATAL_ERROR "plugins were refused:\n${refused}")
endif()
