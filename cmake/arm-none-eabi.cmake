# SPDX-License-Identifier: MIT
# Toolchain file for bare-metal Cortex-M: -DSPLINEFEED_CPU=cortex-m0 (default), cortex-m3, cortex-m4f or cortex-m7.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES SPLINEFEED_CPU)

set(SPLINEFEED_CPU cortex-m0 CACHE STRING "cortex-m0, cortex-m3, cortex-m4f or cortex-m7")
if(SPLINEFEED_CPU STREQUAL cortex-m4f)
    set(cpu_flags "-mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard")
elseif(SPLINEFEED_CPU STREQUAL cortex-m7)
    set(cpu_flags "-mcpu=cortex-m7 -mfpu=fpv5-d16 -mfloat-abi=hard")
elseif(SPLINEFEED_CPU MATCHES "^cortex-m[03]$")
    set(cpu_flags "-mcpu=${SPLINEFEED_CPU} -mfloat-abi=soft")
else()
    message(FATAL_ERROR "SPLINEFEED_CPU is ${SPLINEFEED_CPU}; it can be cortex-m0, cortex-m3, cortex-m4f or cortex-m7")
endif()

set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
# Options of the directory, not CMAKE_CXX_FLAGS: those are kept from the first configuration, also for another processor.
separate_arguments(cpu_flags)
add_compile_options(-mthumb ${cpu_flags} -ffreestanding -ffunction-sections -fdata-sections -fno-unwind-tables
                    -fno-asynchronous-unwind-tables
                    -Wno-psabi) # a note on GCC before 7.1, for each function that takes segments
add_link_options(-mthumb ${cpu_flags})
set(CMAKE_CXX_FLAGS_RELEASE "-Os -DNDEBUG" CACHE STRING "Flags of the build type Release")
