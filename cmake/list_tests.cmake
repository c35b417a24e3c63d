# SPDX-License-Identifier: MIT
# cmake -DPROGRAM= -DPREFIX= -DFILE= [-DCOST=] -P list_tests.cmake: writes one ctest entry per source of PROGRAM that has Catch2 test cases
# into FILE. Under sanitizers a program takes longer to start than most test cases to run.
execute_process(COMMAND ${PROGRAM} --list-tags --filenames-as-tags OUTPUT_VARIABLE tags RESULT_VARIABLE status)
string(REPLACE "[" "" tags "${tags}") # which would join the elements of a list
string(REGEX MATCHALL "\n +[0-9]+  " rows "${tags}")
list(LENGTH rows rows)
string(REGEX MATCHALL "#[A-Za-z0-9_]+" sources "${tags}")

if(NOT DEFINED COST) # tests of a larger one begin first
    set(COST 0)
endif()
set(script "")
foreach(source IN LISTS sources)
    string(SUBSTRING "${source}" 1 -1 name)
    # Where a test cannot run it prints "SKIPPED: reason" and returns (Catch2 3: SKIP("reason")). What failed before is a failure.
    string(APPEND script "add_test(${PREFIX}/${name} [==[${PROGRAM}]==] --filenames-as-tags [==[[#${name}]]==])\n"
                         "set_tests_properties(${PREFIX}/${name} PROPERTIES TIMEOUT 600 PROCESSORS 2 COST ${COST} LABELS ${PREFIX}_tests "
                         "SKIP_REGULAR_EXPRESSION [==[SKIPPED: .*(All tests passed|test cases: [0-9]+ [|] [0-9]+ (passed|skipped)( [|] [0-9]+ skipped)?\n)]==])\n")
endforeach()
# Catch2 2 ends with the number of tags as its status, at most 255; Catch2 3 with 0.
if(rows GREATER 255)
    set(rows 255)
endif()
if(script STREQUAL "" OR NOT (status STREQUAL rows OR status STREQUAL 0))
    message(FATAL_ERROR "${PROGRAM} lists ${rows} tags and ends with status ${status}: it crashed, or it has no test")
endif()
file(WRITE ${FILE} "${script}")
