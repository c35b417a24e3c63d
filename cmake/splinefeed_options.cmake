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

# splinefeed_precompile(target header...): headers that are read once for all of its sources. Each source still includes what
# it uses: builds without SPLINEFEED_PRECOMPILE, such as clang-tidy's, fail otherwise.
function(splinefeed_precompile target)
    if(SPLINEFEED_PRECOMPILE)
        target_precompile_headers(${target} PRIVATE ${ARGN})
        splinefeed_precompiled_options(${target})
    endif()
endfunction()

# What a compiler cache needs to give a precompiled header back: no time in it, and its use seen by the preprocessor. For all
# targets that use it.
function(splinefeed_precompiled_options target)
    if(SPLINEFEED_PRECOMPILE AND CMAKE_CXX_COMPILER_ID MATCHES Clang)
        target_compile_options(${target} PRIVATE "SHELL:-Xclang -fno-pch-timestamp")
    elseif(SPLINEFEED_PRECOMPILE)
        target_compile_options(${target} PRIVATE -fpch-preprocess)
    endif()
endfunction()
