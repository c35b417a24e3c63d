# SPDX-License-Identifier: MIT
# Runs of the tool on simulated drives, each a process of its own, in real time: they mostly wait. To ctest as ./check calls it
# a test that computes is two of its slots (cmake/list_tests.cmake), one of these a single one.
find_package(Python3 COMPONENTS Interpreter QUIET)
# Debian's packages (pymodbus) are for Debian's Python, which may not be the first one.
set(python ${Python3_EXECUTABLE})
if(EXISTS /usr/bin/python3)
    set(python /usr/bin/python3)
endif()

# process_test(name script arguments...). Under sanitizers, which take their time: with ./check --long only.
function(process_test name script)
    if(NOT python)
        skipped_test(${name} "there is no Python 3 (Debian: apt-get install python3)")
        return()
    endif()
    set(command ${python} ${PROJECT_SOURCE_DIR}/tests/modbus/${script} $<TARGET_FILE:splinefeed_tool> ${ARGN})
    if(SPLINEFEED_FUZZERS)
        string(PREPEND name sanitized_)
        list(PREPEND command ${PROJECT_SOURCE_DIR}/tests/tools/if_long.sh "a minute under sanitizers")
    endif()
    add_test(NAME ${name} COMMAND ${command})
    set_tests_properties(${name} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 3600 COST 100)
endfunction()

set(path61 ${PROJECT_SOURCE_DIR}/examples/path61.csv ${PROJECT_SOURCE_DIR}/examples/three_axis.toml)
set(raster3d ${PROJECT_SOURCE_DIR}/examples/raster3d.csv ${PROJECT_SOURCE_DIR}/examples/three_axis.toml)
# Ramps of four times the machine file's acceleration: the path may use all of it.
set(ramp "--address-keys" "&ramp=1.28e6")
set(away ${ramp} --faults disconnect@2.5:900)
# docs/reference/modbus.md states 0.1 um over TCP; the chords of a record each millisecond are 0.13 um off at 1000 mm/s^2 besides, and clocks that are
# known to 1 us are 0.1 um. On a paced line: 1 um, and clocks that differ by 200 us at 100 mm/s.
set(slow)
set(leadshine_mm 0.14)
if(SPLINEFEED_FUZZERS) # a sanitizer keeps the tool from keeping time
    set(slow --slow)
    set(leadshine_mm 12.4)
endif()
process_test(modbus_three_drives_rtu three_drives.py ${path61} --wire rtu --tolerance-mm 0.021 ${slow})
# How near a drive that does not interpolate stays to the path, as docs/reference/modbus.md states it. Where one is away for 0.9 s it leaves the
# path by what the others move meanwhile. The bound grows with the square of the time between two targets: 0.36 mm at 57600 baud.
process_test(modbus_profile_away profile_run.py ${path61} lexium32m --tolerance-mm 12.4 ${slow} ${away})
process_test(modbus_profile_leadshine_pr profile_run.py ${path61} leadshine-pr --wire rtu --tolerance-mm ${leadshine_mm} ${slow} ${ramp})
if(SPLINEFEED_FUZZERS) # under sanitizers one of each kind
    process_test(modbus_faulted_runs faulted_runs.py --kind pvt --wire tcp --runs 8 --long-runs 20 --later 1.5)
    if(SPLINEFEED_BOOST_INCLUDE)
        process_test(modbus_served ../serve/target_runs.py)
    endif()
    return()
endif()
process_test(modbus_three_drives_tcp three_drives.py ${path61} --wire tcp --tolerance-mm 0.0004)
process_test(modbus_three_drives_away three_drives.py ${path61} --wire tcp --tolerance-mm 0.0004 --faults disconnect@1.5:800)
process_test(modbus_three_drives_stall three_drives.py ${path61} --wire tcp --tolerance-mm 0.0004 --stall-ms 260)
process_test(modbus_profile_cia402_index profile_run.py ${path61} cia402-index --tolerance-mm 0.05)
process_test(modbus_profile_oriental_az profile_run.py ${path61} oriental-az --wire rtu --tolerance-mm 0.15 ${ramp})
process_test(modbus_profile_cia402_kinco profile_run.py ${path61} cia402-kinco --wire rtu --baud 57600 --tolerance-mm 0.36 ${ramp})
process_test(modbus_home home_run.py)
process_test(modbus_start start_runs.py)
process_test(modbus_state state_run.py)
process_test(modbus_run_ends run_ends.py)
process_test(modbus_suspended_run suspended_run.py)
process_test(modbus_progress progress_run.py)
if(python)
    add_test(NAME modbus_real_time_judge COMMAND ${python} -B ${PROJECT_SOURCE_DIR}/tests/modbus/real_time_test.py)
endif()
# In a network name space, so as root.
process_test(modbus_pulled_cable pulled_cable.py ${path61} --away-s 3.3)
process_test(modbus_netem pulled_cable.py ${path61} --netem "delay 2ms 1ms 25% loss 2%" --far 3)
# The same over 50 s, alone: on a busy machine a line's answers come too late now and then, and all stop and go on.
process_test(modbus_raster3d_tcp three_drives.py ${raster3d} --wire tcp --tolerance-mm 0.0004 --if-long)
process_test(modbus_raster3d_rtu three_drives.py ${raster3d} --wire rtu --tolerance-mm 0.021 --if-long)
set_tests_properties(modbus_raster3d_tcp modbus_raster3d_rtu PROPERTIES RUN_SERIAL TRUE)
# Drives that know nothing of ours but docs/reference/pvt_map.md: their shafts follow exactly. One drive has one clock, so what is left is
# rounding; three are off by what is not known of their clocks, as above.
process_test(modbus_pymodbus_drive pymodbus_drives.py ${path61} --drives 1 --tolerance-mm 0.0005)
process_test(modbus_pymodbus_three_drives pymodbus_drives.py ${path61} --drives 3 --tolerance-mm 0.003)
process_test(modbus_spindle spindle_runs.py)
process_test(modbus_inputs input_runs.py)
process_test(modbus_pauses pause_runs.py)
process_test(modbus_faulted_runs faulted_runs.py --kind pvt --wire tcp --runs 30 --long-runs 200)
process_test(modbus_faulted_profile_runs faulted_runs.py --kind block --wire tcp --runs 8 --long-runs 200)
process_test(modbus_faulted_cyclic_runs faulted_runs.py --kind cyclic --wire tcp --runs 8 --long-runs 200)
process_test(modbus_paused_input paused_input.py)
# Stops at random times, by signals, with inputs that stall, outputs that nobody reads and drives that are lost.
process_test(modbus_stopped_runs stopped_runs.py --runs 30 --long-runs 300 --jobs 4)
foreach(name faulted_runs faulted_profile_runs faulted_cyclic_runs) # they have a pool of their own
    if(TEST modbus_${name})
        set_tests_properties(modbus_${name} PROPERTIES PROCESSORS 2)
    endif()
endforeach()
# What a drive without a buffer of motion, a serial line or a bound of micrometres cannot bear is a machine whose processors are
# all busy. These come first, by their cost, and so beside one another only.
foreach(name three_drives_rtu profile_away profile_leadshine_pr profile_cia402_index profile_oriental_az profile_cia402_kinco
             pymodbus_three_drives)
    if(TEST modbus_${name})
        set_tests_properties(modbus_${name} PROPERTIES PROCESSORS 2 COST 3000)
    endif()
endforeach()
if(TEST modbus_stopped_runs)
    set_tests_properties(modbus_stopped_runs PROPERTIES PROCESSORS 4 COST 4000)
endif()
