# SPDX-License-Identifier: MIT
# As many compilers at once as the memory has room for: a group of sources takes up to 1.0 GB, so a Raspberry Pi of 2 GB compiles one at a time.
# Ninja keeps to it; with other generators -j says how many.
cmake_host_system_information(RESULT memory_mb QUERY TOTAL_PHYSICAL_MEMORY)
set(SPLINEFEED_MEMORY_MB ${memory_mb} CACHE STRING "Memory that compilers may take at once [MB]")
cmake_host_system_information(RESULT processors QUERY NUMBER_OF_LOGICAL_CORES)
math(EXPR compilers "${SPLINEFEED_MEMORY_MB} / 1000")
if(compilers LESS 1)
    set(compilers 1)
endif()
if(compilers LESS_EQUAL processors)
    set_property(GLOBAL APPEND PROPERTY JOB_POOLS compilers=${compilers})
    set(CMAKE_JOB_POOL_COMPILE compilers)
endif()
