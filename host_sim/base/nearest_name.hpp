// SPDX-License-Identifier: MIT
// nearest_name: the known name that a mistyped name probably means.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace splinefeed::host {

/// The known name with the fewest edits (insert, delete, replace, swap of neighbours; case is ignored). Empty if no
/// name is close: more than a third of the name and more than two edits, or any edit in a name of one or two letters.
/// Cost: the product of the lengths.
[[nodiscard]] std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known);

/// nearest_name(); else the one known name with the same words or words of that meaning: max_velocity_mm_s for
/// `max_velocity`, `seek`, `speed`. Empty if there is none, or two that are as good.
[[nodiscard]] std::string_view meant_name(std::string_view name, std::span<const std::string_view> known);

/// "a, b, c"
[[nodiscard]] std::string listed(std::span<const std::string_view> names);

/// "; did you mean 'b'?" if a name is close, otherwise "; known are a, b, c", or of many names the page that lists
/// them.
[[nodiscard]] std::string suggestion(std::string_view name, std::span<const std::string_view> known,
                                     std::string_view page = {});

} // namespace splinefeed::host
