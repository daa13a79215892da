# run with programs that stand in for elvis and elvis_hunt.
#   -DRUN=script -DWORK=folder to work in
cmake_policy(VERSION 3.25)
file(REMOVE_RECURSE "${WORK}")
file(WRITE "${WORK}/bin/elvis" [=[#!/bin/sh
# Writes what --stats names, and answers {}.
[ "$1" = --version ] && { echo 'elvis "9"'; exit 0; }
while [ $# -gt 0 ]; do
    [ "$1" = --stats ] && printf '{\n  "milliseconds": {\n    "total": %s\n  }\n}\n' "$TOTAL" >"$2"
    shift
done
echo '{}'
]=])
file(WRITE "${WORK}/bin/elvis_hunt" [=[#!/bin/sh
while [ $# -gt 0 ]; do
    [ "$1" = --json ] && echo '{"sums": []}' >"$2"
    shift
done
[ "$GOOD" = 1 ] && exit 0
printf 'row 3 is "far" off,\nby C:\\path\n'
exit 1
]=])
file(CHMOD "${WORK}/bin/elvis" "${WORK}/bin/elvis_hunt" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
set(ENV{ELVIS} "${WORK}/bin/elvis")

# run(WANTED ARGUMENT...): exit status and arguments; `results` is what it wrote.
function(run_it wanted)
  file(REMOVE "${WORK}/results.json")
  execute_process(COMMAND "${RUN}" ${ARGN} WORKING_DIRECTORY "${WORK}" RESULT_VARIABLE status ERROR_VARIABLE output OUTPUT_VARIABLE output)
  if(NOT status EQUAL wanted)
    message(FATAL_ERROR "status ${status} in place of ${wanted}: ${output}")
  endif()
  set(results "")
  if(EXISTS "${WORK}/results.json")
    file(READ "${WORK}/results.json" results)
  endif()
  set(results "${results}" PARENT_SCOPE)
endfunction()

# expect(VALUE KEY...): at that place in `results`.
function(expect value)
  string(JSON found GET "${results}" ${ARGN})
  if(NOT found STREQUAL value)
    message(FATAL_ERROR "${ARGN} is '${found}', not '${value}': ${results}")
  endif()
endfunction()

set(ENV{GOOD} 1)
set(ENV{TOTAL} 1999.5)
run_it(0 -o results.json)
expect("[]" failed)
expect("elvis \"9\"" version)
expect(ON start_to_picture is_met_without_cache)
expect("{}" kernels)
string(JSON n_pictures LENGTH "${results}" pictures)
if(NOT n_pictures EQUAL 5) # The scenes, and four volumes.
  message(FATAL_ERROR "${n_pictures} sums of pictures: ${results}")
endif()

set(ENV{TOTAL} 2000.5)
run_it(0 --quick -o results.json)
expect(OFF start_to_picture is_met_with_cache)

set(ENV{GOOD} 0)
run_it(1 --quick -o results.json)
expect("pictures" failed 0)
expect("row 3 is \"far\" off, by C:\\path" pictures 0 error)
expect("{}" kernels)

# Usage, and a file that cannot be written.
run_it(2 --what)
run_it(2 -o)
run_it(1 --quick -o nowhere/results.json)
set(ENV{ELVIS} "")
