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

# splinefeed_sanitize_fully(target): of code that a microcontroller runs also each access's alignment, and the lines of what is
# found. In the host tools and the tests, which are ten times as much code, that is a quarter of the time of compiling them. The
# checks for null and for an object's size find nothing that AddressSanitizer does not.
function(splinefeed_sanitize_fully target)
    if(SPLINEFEED_FUZZERS)
        target_compile_options(${target} PRIVATE -gline-tables-only -fsanitize=alignment)
    endif()
endfunction()

# splinefeed_precompile(target header...): headers that are read once for all of its sources. Each source still includes what
# it uses: builds without SPLINEFEED_PRECOMPILE, such as those by g++, fail otherwise.
function(splinefeed_precompile target)
    if(SPLINEFEED_PRECOMPILE)
        target_precompile_headers(${target} PRIVATE ${ARGN})
        splinefeed_precompiled_options(${target})
    endif()
endfunction()

# What a compiler cache needs to give a precompiled header back: no time in it, and its use seen by the preprocessor. For all
# targets that use it.
function(splinefeed_precompiled_options target)
    if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
        target_compile_options(${target} PRIVATE "SHELL:-Xclang -fno-pch-timestamp")
    else()
        target_compile_options(${target} PRIVATE -fpch-preprocess)
    endif()
endfunction()

# splinefeed_unity(target [group=regex...]): its sources at once, in groups that share what takes most of their time: headers of one
# library, or templates of one stage. A source belongs to the first group whose regex its path from here matches; else to its folder.
# clang-tidy and the preset dev compile each source alone. No source may name something for itself as a header does: the sources
# behind it would get the wrong one (tests/tools/hidden_names.py looks).
function(splinefeed_unity target)
    if(NOT SPLINEFEED_UNITY_BUILD OR CMAKE_SYSTEM_NAME STREQUAL Generic)
        return()
    endif()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    # clang takes a name that another source has for itself for a shadowed one. Alone each source is looked at (clang-tidy, the preset clang).
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:Clang>:-Wno-shadow>)
    get_target_property(sources ${target} SOURCES)
    foreach(source IN LISTS sources)
        get_filename_component(path ${source} ABSOLUTE)
        file(RELATIVE_PATH path ${CMAKE_CURRENT_SOURCE_DIR} ${path})
        get_filename_component(group ${path} DIRECTORY)
        foreach(choice IN LISTS ARGN)
            string(REGEX MATCH "^([a-z]+)=(.*)$" choice "${choice}")
            set(name ${CMAKE_MATCH_1})
            if(path MATCHES "${CMAKE_MATCH_2}")
                set(group ${name})
                break()
            endif()
        endforeach()
        string(MAKE_C_IDENTIFIER ${group} group)
        set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endforeach()
endfunction()
