# SPDX-License-Identifier: MIT
# Installs headers, archives and the package files for find_package(splinefeed CONFIG).
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/splinefeed)
install(TARGETS splinefeed_core splinefeed_hal EXPORT splinefeed_targets)
if(TARGET splinefeed_hal_modbus)
    install(TARGETS splinefeed_hal_modbus EXPORT splinefeed_targets)
    set(SPLINEFEED_HAS_MODBUS ON)
endif()
if(TARGET splinefeed_hal_gpio)
    install(TARGETS splinefeed_hal_gpio EXPORT splinefeed_targets)
endif()
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
