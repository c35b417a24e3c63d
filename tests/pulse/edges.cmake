# SPDX-License-Identifier: MIT
# The path from the edges of path61 alone, by a script that knows nothing of the engines.
find_package(Python3 COMPONENTS Interpreter QUIET)
foreach(case "intervals" "fixed rate" "interpolated" "on edges" "two motors")
    string(REPLACE " " "_" name ${case})
    if(NOT Python3_FOUND)
        skipped_test(pulse_edges_${name} "there is no Python 3 (Debian: apt-get install python3)")
        continue()
    endif()
    add_test(NAME pulse_edges_${name}
             COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/tests/pulse/edges_path.py $<TARGET_FILE:splinefeed_tool>
                     ${PROJECT_SOURCE_DIR}/examples/path61.csv ${PROJECT_SOURCE_DIR}/examples/three_axis.toml ${case})
    set_tests_properties(pulse_edges_${name} PROPERTIES PROCESSORS 2)
endforeach()
