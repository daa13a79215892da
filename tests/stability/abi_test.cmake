# Compares the types of the plugin interface with the baseline, by libabigail.
#   -DLIBRARY=library built from abi_surface.c -DBASELINE=file.abi -DABIDIFF=abidiff
execute_process(COMMAND "${ABIDIFF}" --no-show-locs "${BASELINE}" "${LIBRARY}" RESULT_VARIABLE result OUTPUT_VARIABLE output
                ERROR_VARIABLE output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "The binary interface differs from ${BASELINE} (abidiff: ${result}).\n${output}\n"
                      "Plugins that exist may break. If members were only added at the end of structs, say so in CHANGELOG.md and write the "
                      "baseline anew:\n  tests/stability/freeze.py --build BUILD --baseline")
endif()
