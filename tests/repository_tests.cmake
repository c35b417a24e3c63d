# SPDX-License-Identifier: MIT
# Tests of the whole repository, run by ./check: other compilers, sanitizers, fuzzers, firmware, package, style.
include(ProcessorCount)
ProcessorCount(cores)

# repository_test(name script arguments...): `cores` of the machine are its own; status 77 means skipped.
function(repository_test name script)
    add_test(NAME ${name} COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/${script} ${ARGN} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    set_tests_properties(${name} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 3600 PROCESSORS ${cores})
endfunction()

# Also clang's warnings, and the fuzzers; the optimised build adds the bits of clang's arithmetic.
repository_test(asan_tests tools/preset.sh asan clang++)
repository_test(clang_build tools/preset.sh clang clang++ --if-long)
foreach(cpu m0 m3 m4f)
    repository_test(arm_link_${cpu} arm/link_proof.sh cortex-${cpu} ${PROJECT_BINARY_DIR})
    repository_test(arm_pulse_${cpu} arm/pulse_proof.sh cortex-${cpu} ${PROJECT_BINARY_DIR})
endforeach()
repository_test(valgrind_runs modbus/valgrind_runs.sh ${PROJECT_BINARY_DIR} --if-long)
repository_test(tsan_runs modbus/tsan_runs.sh --if-long)
repository_test(gpio_vm_runs gpio/vm/runs.sh ${PROJECT_BINARY_DIR})
repository_test(gpio_vm_selftest gpio/vm/selftest.sh ${PROJECT_BINARY_DIR} --if-long)
repository_test(install_consumer install/consumer.sh ${PROJECT_BINARY_DIR})
repository_test(readme_example tools/readme_example.sh ${PROJECT_BINARY_DIR})
repository_test(format tools/format.sh)
repository_test(tidy tools/tidy.sh ${PROJECT_BINARY_DIR})
repository_test(scripts tools/scripts.sh)
repository_test(mutation tools/mutation.sh --if-long)
repository_test(fresh_debian tools/fresh_debian.sh --if-long)
