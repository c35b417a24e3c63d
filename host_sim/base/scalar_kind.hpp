// SPDX-License-Identifier: MIT
// ScalarKind: the number type of the core, as --scalar names it: fixed, float, double.
#pragma once

#include <initializer_list>
#include <string_view>

namespace splinefeed::host {

enum class ScalarKind { fixed, float32, float64 };

/// The kind of that name. Throws UsageError unless it is one of `known`. @param option  that names it
[[nodiscard]] ScalarKind read_scalar(std::string_view option, std::string_view name,
                                     std::initializer_list<std::string_view> known);

} // namespace splinefeed::host
