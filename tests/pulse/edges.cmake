# SPDX-License-Identifier: MIT
# The path from the edges of path61 alone, by a script that knows nothing of the engines.
find_package(Python3 COMPONENTS Interpreter QUIET)
if(NOT Python3_FOUND)
    message(WARNING "Without Python 3 the edges of path61 are not followed (Debian: apt-get install python3)")
    return()
endif()
foreach(case "intervals" "fixed rate" "on edges" "two motors")
    string(REPLACE " " "_" name ${case})
    add_test(NAME pulse_edges_${name}
             COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/tests/pulse/edges_path.py $<TARGET_FILE:splinefeed_tool>
                     ${PROJECT_SOURCE_DIR}/examples/path61.csv ${PROJECT_SOURCE_DIR}/examples/three_axis.toml ${case})
endforeach()
