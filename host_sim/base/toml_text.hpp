// SPDX-License-Identifier: MIT
// parse_toml: parses a TOML document, without what toml++ must not get.
#pragma once

#include <string>
#include <string_view>
#include <toml++/toml.h>

namespace splinefeed::host {

/// Throws InputError, with the line, if the text is no TOML: in the user's words where they can be found, else as the
/// parser says it. toml++ 3.3 has undefined behaviour if the name of a table does not start like a key, if there are
/// letters beyond ASCII outside strings and comments where it looks for blanks, and if a } stands in the place of a
/// value. None of this is valid TOML. All of it is refused before, and also such letters in a string that might be
/// taken for something else. A name of more than 17 parts is refused, because it would be nested tables, which the
/// parser handles by recursion.
[[nodiscard]] toml::table parse_toml(std::string_view toml, const std::string& file);

} // namespace splinefeed::host
