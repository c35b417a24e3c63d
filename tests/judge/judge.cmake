# SPDX-License-Identifier: MIT
# The judge, on runs that are known, and what it says of the runs that README.md has figures of.
if(NOT EXISTS /usr/bin/python3)
    message(WARNING "Without Debian's Python 3 nothing judges the runs (Debian: apt-get install python3-numpy python3-scipy)")
    return()
endif()

function(judge_test name script)
    add_test(NAME ${name} COMMAND /usr/bin/python3 -B ${PROJECT_SOURCE_DIR}/tests/judge/${script} ${ARGN})
    # One core: linear algebra of this size gains nothing from more.
    set_tests_properties(${name} PROPERTIES TIMEOUT 1200 ENVIRONMENT "OMP_NUM_THREADS=1;OPENBLAS_NUM_THREADS=1")
endfunction()

if(SPLINEFEED_FUZZERS) # sanitizers look for something else
    return()
endif()
judge_test(judge_of_known_runs judge_test.py)
foreach(program path61.csv circle720.csv butterfly.json uneven)
    string(REGEX REPLACE "\\..*" "" name ${program})
    judge_test(judge_gates_${name} gates.py $<TARGET_FILE:splinefeed_tool> ${program})
endforeach()
