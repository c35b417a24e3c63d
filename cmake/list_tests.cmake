# SPDX-License-Identifier: MIT
# cmake -DPROGRAM= -DPREFIX= -DFILE= [-DCOST=] -P list_tests.cmake: writes one ctest entry per Catch2 test case of PROGRAM into FILE.
# Catch2's own catch_discover_tests loses tests whose names hold brackets or semicolons.
execute_process(COMMAND ${PROGRAM} --list-test-names-only OUTPUT_VARIABLE names RESULT_VARIABLE status ERROR_QUIET)
set(counted ON) # Catch2 2 ends with the number of tests as its status: of 8 bits
if(names STREQUAL "") # Catch2 3
    execute_process(COMMAND ${PROGRAM} --list-tests --verbosity quiet OUTPUT_VARIABLE names RESULT_VARIABLE status)
    set(counted OFF)
endif()
# What would split or join the elements of a list becomes control characters for a while.
string(ASCII 1 2 3 controls)
string(SUBSTRING "${controls}" 0 1 open)
string(SUBSTRING "${controls}" 1 1 close)
string(SUBSTRING "${controls}" 2 1 semicolon)
string(REPLACE "[" "${open}" names "${names}")
string(REPLACE "]" "${close}" names "${names}")
string(REPLACE ";" "${semicolon}" names "${names}")
string(REPLACE "\n" ";" names "${names}")

if(NOT DEFINED COST) # tests of a larger one begin first
    set(COST 0)
endif()
set(script "")
set(count 0)
foreach(name IN LISTS names)
    if(name STREQUAL "")
        continue()
    endif()
    math(EXPR count "${count} + 1")
    string(REPLACE "\\" "\\\\" pattern "${name}")
    string(REPLACE "," "\\," pattern "${pattern}")
    string(REPLACE "${open}" "\\[" pattern "${pattern}")
    foreach(text name pattern)
        string(REPLACE "${open}" "[" ${text} "${${text}}")
        string(REPLACE "${close}" "]" ${text} "${${text}}")
        string(REPLACE "${semicolon}" ";" ${text} "${${text}}")
    endforeach()
    # Where a test cannot run it prints "SKIPPED: reason" and returns (Catch2 3: SKIP("reason")). What failed before is a failure.
    string(APPEND script "add_test([==[${PREFIX}/${name}]==] [==[${PROGRAM}]==] [==[${pattern}]==])\n"
                         "set_tests_properties([==[${PREFIX}/${name}]==] PROPERTIES TIMEOUT 600 PROCESSORS 2 COST ${COST} LABELS ${PREFIX}_tests "
                         "SKIP_REGULAR_EXPRESSION [==[SKIPPED: .*(All tests passed|test cases: 1 [|] 1 (passed|skipped))]==])\n")
endforeach()
set(expected 0)
if(counted)
    set(expected ${count})
    if(count GREATER 255)
        set(expected 255) # the largest status that Catch2 2 returns
    endif()
endif()
if(count EQUAL 0 OR NOT status STREQUAL expected)
    message(FATAL_ERROR "${PROGRAM} lists ${count} tests and ends with status ${status}: it crashed, or it has no test")
endif()
file(WRITE ${FILE} "${script}")
