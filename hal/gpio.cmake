# SPDX-License-Identifier: MIT
# splinefeed::hal_gpio, where libgpiod is. Its versions 1 and 2 have different interfaces under one name: the header says
# which it is, and that decides which source is compiled. Whoever links it has SPLINEFEED_HAS_GPIO.
set(SPLINEFEED_GPIOD_PREFIX "" CACHE PATH "Where libgpiod is, if not the system's: the folder of include/ and lib/")
if(NOT SPLINEFEED_GPIOD_PREFIX STREQUAL "${SPLINEFEED_GPIOD_SEARCHED}")
    unset(SPLINEFEED_GPIOD_INCLUDE CACHE)
    unset(SPLINEFEED_GPIOD_LIBRARY CACHE)
endif()
set(SPLINEFEED_GPIOD_SEARCHED "${SPLINEFEED_GPIOD_PREFIX}" CACHE INTERNAL "The prefix of what was found")

if(SPLINEFEED_GPIOD_PREFIX)
    find_path(SPLINEFEED_GPIOD_INCLUDE gpiod.h PATHS "${SPLINEFEED_GPIOD_PREFIX}/include" NO_DEFAULT_PATH)
    find_library(SPLINEFEED_GPIOD_LIBRARY gpiod PATHS "${SPLINEFEED_GPIOD_PREFIX}"
                 PATH_SUFFIXES lib lib/${CMAKE_LIBRARY_ARCHITECTURE} NO_DEFAULT_PATH)
    if(NOT SPLINEFEED_GPIOD_INCLUDE OR NOT SPLINEFEED_GPIOD_LIBRARY)
        message(FATAL_ERROR "SPLINEFEED_GPIOD_PREFIX is ${SPLINEFEED_GPIOD_PREFIX}, and there is no include/gpiod.h with a "
                            "lib/libgpiod.so in it; correct it, or leave it out")
    endif()
else()
    find_path(SPLINEFEED_GPIOD_INCLUDE gpiod.h)
    find_library(SPLINEFEED_GPIOD_LIBRARY gpiod)
    if(NOT SPLINEFEED_GPIOD_INCLUDE OR NOT SPLINEFEED_GPIOD_LIBRARY)
        message(STATUS "No libgpiod (Debian: apt-get install libgpiod-dev): without splinefeed::hal_gpio")
        return()
    endif()
endif()

file(STRINGS ${SPLINEFEED_GPIOD_INCLUDE}/gpiod.h version_1 REGEX "^struct gpiod_line_bulk {" LIMIT_COUNT 1)
file(STRINGS ${SPLINEFEED_GPIOD_INCLUDE}/gpiod.h version_2 REGEX "^int gpiod_line_config_add_line_settings"
     LIMIT_COUNT 1)
if(version_1)
    set(gpiod_version 1)
elseif(version_2)
    set(gpiod_version 2)
else()
    message(WARNING "${SPLINEFEED_GPIOD_INCLUDE}/gpiod.h is neither of libgpiod 1.x nor 2.x: without splinefeed::hal_gpio")
    return()
endif()

file(GLOB gpio_sources CONFIGURE_DEPENDS splinefeed/hal/gpio/*.cpp)
list(FILTER gpio_sources EXCLUDE REGEX "/pins_v[12]\\.cpp$")
add_library(splinefeed_hal_gpio STATIC ${gpio_sources} splinefeed/hal/gpio/pins_v${gpiod_version}.cpp)
add_library(splinefeed::hal_gpio ALIAS splinefeed_hal_gpio)
splinefeed_options(splinefeed_hal_gpio)
splinefeed_unity(splinefeed_hal_gpio "pins=/pins_v") # which a test replaces
splinefeed_sanitize_fully(splinefeed_hal_gpio)
splinefeed_precompile(splinefeed_hal_gpio <algorithm> <atomic> <functional> <memory> <mutex> <string> <thread> <vector>)
target_include_directories(splinefeed_hal_gpio SYSTEM PRIVATE ${SPLINEFEED_GPIOD_INCLUDE})
target_link_libraries(splinefeed_hal_gpio PUBLIC splinefeed_hal_rt
                                          PRIVATE Threads::Threads
                                                  $<BUILD_INTERFACE:${SPLINEFEED_GPIOD_LIBRARY}>$<INSTALL_INTERFACE:gpiod>)
target_compile_definitions(splinefeed_hal_gpio INTERFACE SPLINEFEED_HAS_GPIO=${gpiod_version})
set_target_properties(splinefeed_hal_gpio PROPERTIES EXPORT_NAME hal_gpio)
message(STATUS "libgpiod ${gpiod_version}.x: ${SPLINEFEED_GPIOD_LIBRARY}")
