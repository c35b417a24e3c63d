// SPDX-License-Identifier: MIT
// toml_text: what a TOML text must not hold before toml++ may see it.
#pragma once

#include <string>
#include <string_view>

namespace splinefeed::host {

/// toml++ 3.3 has undefined behaviour where the name of a table does not start like a key, and where it looks for
/// blanks among letters beyond ASCII, as it does outside of texts and comments, and where a } stands in place of a
/// value. None of it is TOML; all are refused here, with their line, and so are such letters in a text that might be
/// taken for something else. A name of more than 17 parts would be as many tables within one another, for which the
/// parser calls itself. Throws InputError.
void require_plain_toml(std::string_view toml, const std::string& file);

} // namespace splinefeed::host
