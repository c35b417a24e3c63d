# SPDX-License-Identifier: MIT
# ccache, where it is installed and nobody said otherwise (CMAKE_CXX_COMPILER_LAUNCHER): what was compiled once, in whatever
# folder, is found again.
if(CMAKE_SYSTEM_NAME STREQUAL Generic)
    set(CMAKE_CXX_COMPILER_LAUNCHER "") # ccache does not keep the call graph that the bound of the stack is made of
    return()
endif()
find_program(SPLINEFEED_CCACHE ccache)
if(NOT SPLINEFEED_CCACHE OR DEFINED CMAKE_CXX_COMPILER_LAUNCHER OR DEFINED ENV{CMAKE_CXX_COMPILER_LAUNCHER})
    return()
endif()
# Paths below the repository count as relative ones; what is included is known from the compiler's own list of dependencies,
# which costs nothing where nothing is found; and precompiled headers ask for the sloppiness (ccache's manual says why).
set(CMAKE_CXX_COMPILER_LAUNCHER
    env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 CCACHE_DEPEND=1
    CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${SPLINEFEED_CCACHE})
