// SPDX-License-Identifier: MIT
// toml_text: refuses text that toml++ must not get.
#pragma once

#include <string>
#include <string_view>

namespace splinefeed::host {

/// toml++ 3.3 has undefined behaviour if the name of a table does not start like a key, if there are letters beyond
/// ASCII outside strings and comments where it looks for blanks, and if a } stands in the place of a value. None of
/// this is valid TOML. All of it is refused here, with its line, and also such letters in a string that might be taken
/// for something else. A name of more than 17 parts is refused, because it would be nested tables, which the parser
/// handles by recursion. Throws InputError.
void require_plain_toml(std::string_view toml, const std::string& file);

} // namespace splinefeed::host
