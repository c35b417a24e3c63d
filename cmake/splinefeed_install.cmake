# SPDX-License-Identifier: MIT
# Installs headers, archives and the package files for find_package(splinefeed CONFIG).
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/splinefeed)
install(TARGETS splinefeed_core splinefeed_hal EXPORT splinefeed_targets)
if(TARGET splinefeed_hal_rt)
    set(SPLINEFEED_HAS_RT ON)
endif()
foreach(library IN ITEMS splinefeed_hal_rt splinefeed_hal_modbus splinefeed_hal_gpio)
    if(TARGET ${library})
        install(TARGETS ${library} EXPORT splinefeed_targets)
    endif()
endforeach()
install(DIRECTORY firmware_core/splinefeed hal/splinefeed TYPE INCLUDE FILES_MATCHING PATTERN *.hpp)
install(
    EXPORT splinefeed_targets
    NAMESPACE splinefeed::
    FILE splinefeedTargets.cmake
    DESTINATION ${package_dir})
configure_package_config_file(cmake/splinefeedConfig.cmake.in ${PROJECT_BINARY_DIR}/splinefeedConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/splinefeedConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/splinefeedConfig.cmake ${PROJECT_BINARY_DIR}/splinefeedConfigVersion.cmake
        DESTINATION ${package_dir})

# For build systems that ask pkg-config. The folder of the installation is found from that of the file: it can be moved.
file(RELATIVE_PATH pc_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
set(pc_capacities "")
if(NOT SPLINEFEED_MAX_AXES EQUAL 6)
    string(APPEND pc_capacities " -DSPLINEFEED_MAX_AXES=${SPLINEFEED_MAX_AXES}")
endif()
if(NOT SPLINEFEED_MAX_DEGREE EQUAL 9)
    string(APPEND pc_capacities " -DSPLINEFEED_MAX_DEGREE=${SPLINEFEED_MAX_DEGREE}")
endif()
configure_file(cmake/splinefeed.pc.in ${PROJECT_BINARY_DIR}/splinefeed.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/splinefeed.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
