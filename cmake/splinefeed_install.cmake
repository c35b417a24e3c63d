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
