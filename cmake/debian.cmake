# SPDX-License-Identifier: MIT
# Debian's packages by CPack, from a build with the prefix /usr: cmake/packaging/debian.sh. splinefeed has the tool with its pages,
# libsplinefeed-dev headers and archives, python3-splinefeed and linuxcnc-splinefeed the modules of Python and LinuxCNC where they are built.
set(SPLINEFEED_PACKAGE_CONTACT "the splinefeed authors <splinefeed@splinefeed.invalid>" CACHE STRING "Who answers for the packages")
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${SPLINEFEED_PACKAGE_CONTACT}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # each package has its own
set(CPACK_COMPONENTS_ALL tool dev)

set(CPACK_DEBIAN_TOOL_PACKAGE_NAME splinefeed)
set(CPACK_DEBIAN_TOOL_PACKAGE_SECTION utils)
set(CPACK_DEBIAN_TOOL_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_TOOL_DESCRIPTION "waypoints and G-code become smooth motion
splinefeed plans the motion of machines with one to six axes along smooth
curves, within the limits of each axis. It runs it in a simulated machine,
on drives on Modbus, or as step and direction on GPIO lines.")
# A unit for each machine that is served, and rules for what it opens. docs/how-to/install_it.md says how they are used.
set(units ${PROJECT_SOURCE_DIR}/cmake/packaging/systemd)
install(FILES ${units}/splinefeed-serve@.service DESTINATION lib/systemd/system COMPONENT tool)
install(FILES ${units}/60-splinefeed.rules DESTINATION lib/udev/rules.d COMPONENT tool)
set(CPACK_DEBIAN_TOOL_PACKAGE_CONTROL_EXTRA "${units}/postinst;${units}/prerm;${units}/postrm")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libsplinefeed-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libmodbus-dev, libgpiod-dev")
set(CPACK_DEBIAN_DEV_DESCRIPTION "motion core of splinefeed - headers and archives
A freestanding C++20 library that plans smooth motion, with ports to drives
on Modbus and to GPIO lines, for CMake and pkg-config.")

if(SPLINEFEED_HAS_PYTHON)
    list(APPEND CPACK_COMPONENTS_ALL python)
    math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-splinefeed)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
        "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_minor}), python3-numpy")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS python3-matplotlib)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS python3-distributed)
    set(CPACK_DEBIAN_PYTHON_DESCRIPTION "motion planning of splinefeed - Python module
Motions along smooth curves through points and of G-code, with samples of
all derivatives as numpy arrays. It plans with the bits of the command.")
    # What Python compiles it removes itself.
    set(scripts ${PROJECT_BINARY_DIR}/debian)
    file(WRITE ${scripts}/postinst "#!/bin/sh\nset -e\nif command -v py3compile >/dev/null; then py3compile -p python3-splinefeed; fi\n")
    file(WRITE ${scripts}/prerm "#!/bin/sh\nset -e\nif command -v py3clean >/dev/null; then py3clean -p python3-splinefeed; fi\n")
    file(CHMOD ${scripts}/postinst ${scripts}/prerm PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${scripts}/postinst;${scripts}/prerm")
endif()

if(TARGET splinefeed_tp)
    list(APPEND CPACK_COMPONENTS_ALL linuxcnc)
    # It is compiled for the structures of one version of LinuxCNC.
    execute_process(COMMAND dpkg-query --show --showformat=\${Version} linuxcnc-uspace-dev OUTPUT_VARIABLE linuxcnc COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX MATCH "^([0-9]+:)?([0-9]+)\\.([0-9]+)" ignored "${linuxcnc}")
    math(EXPR next_linuxcnc "${CMAKE_MATCH_3} + 1")
    set(CPACK_DEBIAN_LINUXCNC_PACKAGE_NAME linuxcnc-splinefeed)
    set(CPACK_DEBIAN_LINUXCNC_PACKAGE_SECTION misc)
    set(CPACK_DEBIAN_LINUXCNC_PACKAGE_SHLIBDEPS ON)
    set(CPACK_DEBIAN_LINUXCNC_PACKAGE_DEPENDS "linuxcnc-uspace (>= ${CMAKE_MATCH_1}${CMAKE_MATCH_2}.${CMAKE_MATCH_3}~), \
linuxcnc-uspace (<< ${CMAKE_MATCH_1}${CMAKE_MATCH_2}.${next_linuxcnc}~)")
    set(CPACK_DEBIAN_LINUXCNC_DESCRIPTION "motion planning of splinefeed - trajectory planner for LinuxCNC
A module that LinuxCNC loads in place of its own planner, by one line of the
INI file: moves within the limits of each axis, with a jerk limit if wanted.")
    set(linuxcnc_licence "
Comment: This package has a module that is compiled with headers of LinuxCNC and
 is loaded into it. Those are under the GNU General Public License, version 2 or
 later, and so is the module as it is linked. Its text is in
 /usr/share/common-licenses/GPL-2. The sources of splinefeed stay under the
 licence above.")
endif()

# Each package has its licence and a changelog.
file(READ LICENSE licence)
string(REGEX REPLACE "\n" "\n " licence "${licence}")
string(REGEX REPLACE "\n \n" "\n .\n" licence "${licence}")
string(REGEX REPLACE "\n \n" "\n .\n" licence "${licence}")
string(REGEX REPLACE "[ .\n]+$" "." licence "${licence}")
string(REGEX REPLACE "^MIT License" "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\n\nFiles: *\nCopyright: 2026 the splinefeed authors\nLicense: Expat" licence "${licence}")
string(REGEX REPLACE "License: Expat\n \\.\n Copyright [^\n]*\n \\.\n" "License: Expat\n" licence "${licence}")
# third_party(COMPONENT NAME PACKAGE): what is compiled into a component, with the licence that PACKAGE, of which it is taken, has.
function(third_party component name package)
    file(READ /usr/share/doc/${package}/copyright text)
    string(REGEX MATCH "Files: +\\*\nCopyright: *([^\n]+(\n +[^\n]+)*)\nLicense: *([^\n]+)" ignored "${text}")
    set(holders "${CMAKE_MATCH_1}")
    set(terms "${CMAKE_MATCH_3}")
    set(licence "${${component}_licence}\n\nFiles: ${name}\nCopyright: ${holders}\nLicense: ${terms}")
    string(REPLACE "+" "\\+" terms "${terms}")
    if(NOT terms STREQUAL Expat)
        string(REGEX MATCH "\nLicense: *${terms}\n(( [^\n]*\n)+)" ignored "${text}\n")
        string(STRIP "${CMAKE_MATCH_1}" whole)
        string(APPEND licence "\n ${whole}")
    endif()
    set(${component}_licence "${licence}" PARENT_SCOPE)
endfunction()
set(tool_licence "

Files: three.js
Copyright: 2010-2024 three.js authors
License: Expat

Files: uPlot
Copyright: 2022 Leon Sorokin
License: Expat")
third_party(tool CLI11 libcli11-dev)
third_party(tool nlohmann-json nlohmann-json3-dev)
third_party(tool toml++ libtomlplusplus-dev)
if(SPLINEFEED_HAS_PYTHON)
    third_party(python nlohmann-json nlohmann-json3-dev)
    third_party(python toml++ libtomlplusplus-dev)
    third_party(python pybind11 pybind11-dev)
endif()
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
    string(TOUPPER ${component} upper)
    set(name ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
    set(folder ${PROJECT_BINARY_DIR}/debian/${name})
    file(WRITE ${folder}/changelog "${name} (${PROJECT_VERSION}) unstable; urgency=medium\n\n  * What is new: CHANGELOG.md of the sources.\n\n -- ${SPLINEFEED_PACKAGE_CONTACT}  ${now}\n")
    execute_process(COMMAND gzip -9nf ${folder}/changelog COMMAND_ERROR_IS_FATAL ANY)
    file(WRITE ${folder}/copyright "${licence}${${component}_licence}\n")
    install(FILES ${folder}/changelog.gz ${folder}/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name}
            COMPONENT ${component})
endforeach()
include(CPack)
