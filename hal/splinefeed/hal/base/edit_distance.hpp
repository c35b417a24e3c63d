// SPDX-License-Identifier: MIT
// edit_distance: how near two names are, for messages that say what was probably meant.
#pragma once

#include <cstddef>
#include <string_view>

namespace splinefeed::hal {

/// The fewest edits (insert, delete, replace a letter, swap two neighbours) that make one name the other; case is free,
/// and no letter is edited twice (optimal string alignment). Cost: the product of the lengths.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

} // namespace splinefeed::hal
