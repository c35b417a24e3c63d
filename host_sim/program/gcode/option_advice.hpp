// SPDX-License-Identifier: MIT
// option_advice: the option of the tool that helps where a program was refused.
#pragma once

#include "splinefeed/s0_program/program_errors.hpp"

#include <string_view>

namespace splinefeed::host {

/// What stands behind the core's sentence, from its semicolon on. Empty: no option helps.
[[nodiscard]] std::string_view option_advice(ProgramError error);

} // namespace splinefeed::host
