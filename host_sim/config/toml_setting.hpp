// SPDX-License-Identifier: MIT
// toml_setting: sets one value of a TOML document, as --set states it.
#pragma once

#include <string>
#include <string_view>
#include <toml++/toml.h>
#include <vector>

namespace splinefeed::host {

/// "path.max_feed_mm_s=200" or "axis.x.max_jerk_mm_s3=30000": a key of the file, of one of its tables, or of the table
/// in [[axis]] with that name. The value is TOML, or one word without quotes. Throws UsageError where there is no such
/// table, or the text is no setting; whoever reads the document knows its keys.
void apply_setting(toml::table& document, const std::string& setting);

/// The text of a TOML document with these settings, without its comments. Throws InputError where it is none.
[[nodiscard]] std::string with_settings(std::string_view text, const std::string& file,
                                        const std::vector<std::string>& settings);

} // namespace splinefeed::host
