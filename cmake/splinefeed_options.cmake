# SPDX-License-Identifier: MIT
# splinefeed_options(target): the language level, warnings and arithmetic that all code of this repository is built with.
function(splinefeed_options target)
    target_compile_features(${target} PUBLIC cxx_std_20)
    set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
    # Public: inline functions of the headers must round alike in every translation unit, whoever compiles it.
    target_compile_options(${target} PUBLIC -ffp-contract=off)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion)
    if(SPLINEFEED_WERROR)
        target_compile_options(${target} PRIVATE -Werror)
    endif()
    if(CMAKE_SYSTEM_NAME STREQUAL Generic)
        target_compile_options(${target} PRIVATE -fcallgraph-info=su,da) # for the bound of the stack: tests/arm/stack.awk
    endif()
endfunction()
