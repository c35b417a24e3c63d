// SPDX-License-Identifier: MIT
// spindle_section: the table [spindle] of a machine file.
#pragma once

#include "host_sim/base/toml_checker.hpp"
#include "host_sim/config/spindle_description.hpp"

#include <optional>

namespace splinefeed::host {

/// Nothing if the file has no [spindle]. Its lines are read by read_program_pins(). Throws InputError.
[[nodiscard]] std::optional<SpindleDescription> read_spindle(const TomlChecker& check, const toml::table& root);

} // namespace splinefeed::host
