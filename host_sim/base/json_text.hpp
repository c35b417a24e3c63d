// SPDX-License-Identifier: MIT
// parse_json: a JSON document of bounded depth.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace splinefeed::host {

/// Arrays and objects within one another. Curves and surfaces need six.
inline constexpr int deepest_json = 64;

/// Throws InputError, with the line, where the text is no JSON, is nested deeper, or has a number beyond double.
/// @param hint  behind "not JSON"; empty: what the parser says
[[nodiscard]] nlohmann::json parse_json(std::string_view text, const std::string& file, std::string_view hint = {});

} // namespace splinefeed::host
