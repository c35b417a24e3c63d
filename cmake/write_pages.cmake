# SPDX-License-Identifier: MIT
# cmake -DTOOL= -DFOLDER= -P write_pages.cmake: the man pages of the tool and of its commands, compressed without a time as Debian has
# them, and its completion of bash.
set(pages ${FOLDER}/man1)
file(MAKE_DIRECTORY ${pages})
execute_process(COMMAND ${TOOL} --completion OUTPUT_FILE ${FOLDER}/splinefeed COMMAND_ERROR_IS_FATAL ANY)
file(STRINGS ${FOLDER}/splinefeed commands REGEX "^        [a-z]+\\) options=")
list(TRANSFORM commands REPLACE "^ *([a-z]+)\\).*" "\\1")
foreach(command splinefeed ${commands})
    set(page ${pages}/splinefeed-${command}.1)
    if(command STREQUAL splinefeed)
        set(page ${pages}/splinefeed.1)
    endif()
    execute_process(COMMAND ${TOOL} --man ${command} OUTPUT_FILE ${page} COMMAND_ERROR_IS_FATAL ANY)
    execute_process(COMMAND gzip -9nf ${page} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
