# SPDX-License-Identifier: MIT
# What the tool and the page in a browser have in common: text_sources, which are made of files, and host_groups.
# The drive profiles are part of the program: it reads no file of its own at run time.
file(GLOB profiles CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/hal/profiles/*.toml)
list(JOIN profiles "|" joined_profiles)
set(profile_texts ${CMAKE_CURRENT_BINARY_DIR}/shipped_profile_texts.cpp)
add_custom_command(
    OUTPUT ${profile_texts}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${profile_texts} "-DFILES=${joined_profiles}" -P
            ${PROJECT_SOURCE_DIR}/cmake/embed_profiles.cmake
    DEPENDS ${profiles} ${PROJECT_SOURCE_DIR}/cmake/embed_profiles.cmake
    VERBATIM)
# So is the page of reports; page/README.md says how it is made.
set(page ${PROJECT_SOURCE_DIR}/host_sim/report/page/dist/report.html)
set(page_texts ${CMAKE_CURRENT_BINARY_DIR}/page_template.cpp)
add_custom_command(
    OUTPUT ${page_texts}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${page_texts} -DFILE=${page} -P ${PROJECT_SOURCE_DIR}/cmake/embed_page.cmake
    DEPENDS ${page} ${PROJECT_SOURCE_DIR}/cmake/embed_page.cmake
    VERBATIM)
set_source_files_properties(${page_texts} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
set(text_sources ${profile_texts} ${page_texts})
# Groups of sources: splinefeed_unity.
set(host_groups
    "options=(^|/)cli/"
    "json=(^|/)(curve/|surface/|output/.*(summary|curve_writer|element_writer|report_text)|report/run_report|program/(element_curves|element_file|path_input)|config/state_file|base/json_)"
    "toml=(^|/)(config/(gpio_map|io_modules|machine_file|profile_|program_pins|spindle_)|base/toml_)"
    "drive=(^|/)drive/"
    "ports=(^|/)ports/"
    "serve=(^|/)serve/"
    "convert=(^|/)convert/"
    "motion=(^|/)(run|live|planning|analysis|machine|report)/"
    "text=.")
