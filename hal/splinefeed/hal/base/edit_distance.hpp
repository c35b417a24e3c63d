// SPDX-License-Identifier: MIT
// edit_distance: similarity of two names, for messages that suggest what was meant.
#pragma once

#include <cstddef>
#include <string_view>

namespace splinefeed::hal {

/// The smallest number of edits (insert, delete or replace a letter, swap two neighbours) that turn one name into the
/// other. Ignores case; edits no letter twice (optimal string alignment). Cost: product of the lengths.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

} // namespace splinefeed::hal
