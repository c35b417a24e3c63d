// SPDX-License-Identifier: MIT
// nearest_name: what somebody who mistyped a name probably meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace splinefeed::host {

/// The known name with the fewest edits (insert, delete, replace, swap of neighbours; case is free), or an empty one
/// where nothing comes close: more than a third of the name and more than two edits, or any in a name of one or two
/// letters. Cost: the product of the lengths.
[[nodiscard]] std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known);

/// "a, b, c"
[[nodiscard]] std::string listed(std::span<const std::string_view> names);

/// "; did you mean 'b'?" where a name comes close, else "; known are a, b, c".
[[nodiscard]] std::string suggestion(std::string_view name, std::span<const std::string_view> known);

} // namespace splinefeed::host
