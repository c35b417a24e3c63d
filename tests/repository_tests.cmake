# SPDX-License-Identifier: MIT
# Tests of the whole repository, run by ./check: sanitizers and fuzzers, firmware, package, style, and behind --long the rest.
include(ProcessorCount)
ProcessorCount(cores)

# All test programs and fuzzers are built by clang with sanitizers, in a build of its own; ctest runs them with the tests here.
set(sanitized ${PROJECT_SOURCE_DIR}/build/asan)
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/sanitized.cmake
     "if(EXISTS [==[${sanitized}/CTestTestfile.cmake]==])\n    subdirs([==[${sanitized}]==])\n"
     "else()\n    add_test(asan_NOT_BUILT asan_NOT_BUILT)\nendif()\n")
set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/sanitized.cmake)

# repository_test(name [LONG what it takes] [ALONE] script arguments...): status 77 means skipped. LONG: with ./check --long
# only. ALONE: the script uses all processors.
function(repository_test name)
    cmake_parse_arguments(PARSE_ARGV 1 test ALONE LONG "")
    set(words ${test_UNPARSED_ARGUMENTS})
    list(POP_FRONT words script)
    set(command ${CMAKE_CURRENT_SOURCE_DIR}/${script} ${words})
    if(test_LONG)
        list(PREPEND command ${CMAKE_CURRENT_SOURCE_DIR}/tools/if_long.sh ${test_LONG})
    endif()
    add_test(NAME ${name} COMMAND ${command} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    # What takes long begins first.
    set_tests_properties(${name} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 7200 COST 1000 PROCESSORS 2)
    if(test_ALONE)
        math(EXPR slots "2 * ${cores}")
        set_tests_properties(${name} PROPERTIES PROCESSORS ${slots})
    endif()
endfunction()

foreach(cpu m0 m3 m4f)
    repository_test(arm_link_${cpu} ALONE arm/link_proof.sh cortex-${cpu} ${PROJECT_BINARY_DIR})
    repository_test(arm_stages_${cpu} arm/stages_proof.sh cortex-${cpu} ${PROJECT_BINARY_DIR})
    repository_test(arm_pulse_${cpu} arm/pulse_proof.sh cortex-${cpu} ${PROJECT_BINARY_DIR})
    repository_test(arm_blend_${cpu} arm/blend_proof.sh cortex-${cpu} ${PROJECT_BINARY_DIR})
    repository_test(arm_gcode_${cpu} arm/gcode_proof.sh cortex-${cpu} ${PROJECT_BINARY_DIR})
    # One build, which CMake and ninja look at again in each test: not two at a time.
    set_tests_properties(arm_stages_${cpu} arm_pulse_${cpu} arm_blend_${cpu} arm_gcode_${cpu}
                         PROPERTIES DEPENDS arm_link_${cpu} RESOURCE_LOCK arm_build_${cpu})
    set_tests_properties(arm_link_${cpu} arm_stages_${cpu} arm_pulse_${cpu} arm_blend_${cpu} arm_gcode_${cpu}
                         PROPERTIES FIXTURES_SETUP arm_figures)
endforeach()
repository_test(firmware_lm3s6965 firmware/firmware_proof.sh cortex-m3 ${PROJECT_BINARY_DIR} lm3s6965 lm3s6965evb)
repository_test(firmware_stm32f405 firmware/firmware_proof.sh cortex-m4f ${PROJECT_BINARY_DIR} stm32f405 netduinoplus2)
repository_test(firmware_nrf51 firmware/firmware_proof.sh cortex-m0 ${PROJECT_BINARY_DIR} nrf51 microbit)
set_tests_properties(firmware_lm3s6965 firmware_stm32f405 firmware_nrf51 PROPERTIES FIXTURES_SETUP arm_figures)
set_tests_properties(firmware_nrf51 PROPERTIES DEPENDS arm_link_m0 RESOURCE_LOCK arm_build_m0)
set_tests_properties(firmware_lm3s6965 PROPERTIES DEPENDS arm_link_m3 RESOURCE_LOCK arm_build_m3)
set_tests_properties(firmware_stm32f405 PROPERTIES DEPENDS arm_link_m4f RESOURCE_LOCK arm_build_m4f)
# The boards as Modbus drives. The one that QEMU runs keeps time with the host (keeps_time/CMakeLists.txt).
repository_test(firmware_modbus_stm32f405 firmware/firmware_proof.sh cortex-m4f ${PROJECT_BINARY_DIR} stm32f405 not-run drive)
repository_test(firmware_modbus_nrf51 firmware/firmware_proof.sh cortex-m0 ${PROJECT_BINARY_DIR} nrf51 not-run drive)
set_tests_properties(firmware_modbus_stm32f405 PROPERTIES DEPENDS arm_link_m4f RESOURCE_LOCK arm_build_m4f)
set_tests_properties(firmware_modbus_nrf51 PROPERTIES DEPENDS arm_link_m0 RESOURCE_LOCK arm_build_m0)
# Behind all of these, whose figures it compares with docs/reference/budgets.md.
repository_test(arm_budgets arm/budgets.py ${PROJECT_BINARY_DIR})
repository_test(budgets_tool arm/budgets_test.py)
set_tests_properties(arm_budgets PROPERTIES FIXTURES_REQUIRED arm_figures)
repository_test(tidy ALONE tools/tidy.sh)
repository_test(gpio_vm_runs gpio/vm/runs.sh ${PROJECT_BINARY_DIR})
repository_test(install_consumer install/consumer.sh ${PROJECT_BINARY_DIR})
repository_test(install_pkg_config install/pkg_config.sh ${PROJECT_BINARY_DIR})
repository_test(install_subdirectory install/subdirectory.sh)
repository_test(install_single_header install/single_header.sh)
repository_test(install_manifests install/manifests.py)
repository_test(equal_bits bits/equal_bits.py --programs ${PROJECT_BINARY_DIR}/bin/equal_bits ${sanitized}/bin/equal_bits)
repository_test(readme_example tools/readme_example.sh ${PROJECT_BINARY_DIR})
repository_test(two_compilers tools/two_compilers.sh ${PROJECT_BINARY_DIR}/bin/splinefeed ${sanitized}/bin/splinefeed)
repository_test(format tools/format.sh)
repository_test(scripts tools/scripts.sh)
repository_test(rooms tools/rooms.py)
repository_test(refusals tool/refusals.py ${sanitized}/bin/splinefeed)
repository_test(docs_links tools/docs_links.py)
repository_test(docs_blocks ALONE tools/docs_blocks.py ${PROJECT_BINARY_DIR})
repository_test(docs_pictures ../docs/pictures/make.py --check ${PROJECT_BINARY_DIR})
repository_test(doxygen tools/doxygen.sh ${PROJECT_BINARY_DIR})
repository_test(hidden_names tools/hidden_names.py)
repository_test(harness tools/harness.sh ${sanitized}/bin/base_tests)

# Random tests make many more rounds without sanitizers; and each source of a test includes what it uses.
repository_test(gcc_tests LONG "25 minutes" ALONE tools/gcc_tests.sh)
repository_test(install_arduino LONG "a minute" install/arduino.sh)
repository_test(install_own_firmware LONG "a minute" install/own_firmware.sh)
foreach(target gcc-O0 gcc-O2 gcc-O3 clang-O0 clang-O2 clang-O3 aarch64 riscv64 s390x cortex-m0 cortex-m3 cortex-m4f cortex-m7)
    repository_test(equal_bits_${target} LONG "two minutes" bits/equal_bits.py ${target})
endforeach()
repository_test(tsan_runs LONG "10 minutes" ALONE modbus/tsan_runs.sh)
repository_test(valgrind_runs LONG "2 minutes" ALONE modbus/valgrind_runs.sh ${PROJECT_BINARY_DIR})
repository_test(gpio_vm_selftest LONG "a minute" ALONE gpio/vm/selftest.sh ${PROJECT_BINARY_DIR})
repository_test(mutation LONG "8 minutes" tools/mutation.sh)
repository_test(judge_linuxcnc_elements LONG "a minute" judge/linuxcnc_elements.py ${PROJECT_BINARY_DIR}/bin/splinefeed)
repository_test(mutants LONG "about 12 minutes" ALONE mutation/mutants.py)
repository_test(fresh_debian LONG "25 minutes" ALONE tools/fresh_debian.sh)
