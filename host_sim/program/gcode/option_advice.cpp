// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/option_advice.hpp"

#include <utility>

namespace splinefeed::host {

namespace {

constexpr std::pair<ProgramError, std::string_view> helping_options[] = {
    {ProgramError::not_in_dialect, "; --dialect linuxcnc does"},
    {ProgramError::axis_missing, "; --ignore leaves the letter out"},
    {ProgramError::tool_table_missing, "; --tools gives one"},
    {ProgramError::user_code_unsupported, "; --ignore leaves such a word out"},
    {ProgramError::bed_levelling_unsupported, "; --ignore G29 leaves it out"},
    {ProgramError::firmware_retraction_unsupported, "; --ignore G10,G11 leaves it out"},
    {ProgramError::printer_move_unsupported, "; --ignore leaves the word out"},
    {ProgramError::grbl_command_unsupported, "; --ignore $* leaves all of them out"},
};

} // namespace

std::string_view option_advice(ProgramError error) {
    for (const auto& [refused, text] : helping_options) {
        if (refused == error) {
            return text;
        }
    }
    return {};
}

} // namespace splinefeed::host
