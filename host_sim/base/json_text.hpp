// SPDX-License-Identifier: MIT
// parse_json: parses a JSON document of limited depth.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace splinefeed::host {

/// Largest nesting of arrays and objects. Curves and surfaces need six.
inline constexpr int deepest_json = 64;

/// Throws InputError, with the line, if the text is not JSON, is nested more deeply, or has a number beyond double.
/// @param hint  text after "not JSON"; empty: the parser's message
[[nodiscard]] nlohmann::json parse_json(std::string_view text, const std::string& file, std::string_view hint = {});

} // namespace splinefeed::host
