# SPDX-License-Identifier: MIT
# The judge, on runs that are known, and what it says of the runs that README.md has figures of.
function(judge_test name script)
    if(NOT EXISTS /usr/bin/python3)
        skipped_test(${name} "there is no Debian's Python 3 (Debian: apt-get install python3-numpy python3-scipy)")
        return()
    endif()
    add_test(NAME ${name} COMMAND /usr/bin/python3 -B ${PROJECT_SOURCE_DIR}/tests/judge/${script} ${ARGN})
    # One core: linear algebra of this size gains nothing from more.
    set_tests_properties(${name} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 1200 COST 500 PROCESSORS 2 ENVIRONMENT "OMP_NUM_THREADS=1;OPENBLAS_NUM_THREADS=1")
endfunction()

judge_test(judge_of_known_runs judge_test.py)
judge_test(judge_of_known_times known_times_test.py)
judge_test(judge_of_tolerances path_tolerance_test.py $<TARGET_FILE:splinefeed_tool>)
judge_test(judge_tolerances_kept ../../bench/tolerance.py --tool $<TARGET_FILE:splinefeed_tool> --judge --goals)
foreach(program path61.csv circle720.csv butterfly.json uneven known known_without_jerk straight monotone)
    string(REGEX REPLACE "\\..*" "" name ${program})
    judge_test(judge_gates_${name} gates.py $<TARGET_FILE:splinefeed_tool> ${program})
endforeach()
judge_test(judge_fixed_to_double fixed_to_double.py $<TARGET_FILE:splinefeed_tool>)
judge_test(judge_other_meaning other_meaning.py $<TARGET_FILE:splinefeed_tool>)
