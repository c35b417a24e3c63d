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
