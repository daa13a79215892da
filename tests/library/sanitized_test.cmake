# The library's tests, those of solvers whose ranks are threads, and Python's of wrong arguments, with a sanitizer: builds what they
# need in a tree of its own.
#   -DSOURCE=this project -DWORK=folder to build in -DSANITIZER=thread, or address,undefined -DPYTHON=interpreter, or empty
include("${CMAKE_CURRENT_LIST_DIR}/../support/run.cmake")

file(MAKE_DIRECTORY "${WORK}")
# With a sanitizer's own code GCC warns of what is not there.
run(${CMAKE_COMMAND} -S "${SOURCE}" -B "${WORK}" -G Ninja "-DELVIS_SANITIZE=${SANITIZER}" -DCMAKE_BUILD_TYPE=Release -DELVIS_COMPILE_TOGETHER=ON -DELVIS_WARNINGS_AS_ERRORS=OFF
    "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -g1 -DNDEBUG")
set(targets library_test insitu_test)
if(PYTHON)
  list(APPEND targets elvis_python elvis_python_package)
endif()
run(${CMAKE_COMMAND} --build "${WORK}" --target ${targets})
# Drivers are not built with it: what they leave is theirs, and so are the locks that their threads take of each other.
set(ENV{ASAN_OPTIONS} "detect_leaks=0")
set(ENV{TSAN_OPTIONS} "halt_on_error=1:ignore_noninstrumented_modules=1")
run("${WORK}/tests/library/library_test")
run("${WORK}/tests/insitu/insitu_test")
if(PYTHON)
  foreach(library libasan.so libubsan.so)
    execute_process(COMMAND c++ -print-file-name=${library} OUTPUT_VARIABLE path OUTPUT_STRIP_TRAILING_WHITESPACE)
    string(APPEND preloaded " ${path}")
  endforeach()
  set(ENV{ASAN_OPTIONS} "detect_leaks=0:verify_asan_link_order=0")
  run(${CMAKE_COMMAND} -E env "LD_PRELOAD=${preloaded}" "PYTHONPATH=${WORK}/lib/python:${SOURCE}/tests/python" PYTHONDONTWRITEBYTECODE=1
      "ELVIS_PLUGIN_PATH=${WORK}/lib/elvis/plugins" "${PYTHON}" -m unittest test_values test_arrays)
endif()
