// SPDX-License-Identifier: MIT
// help_pages: the man pages and the completion of bash, made from the commands and options that --help shows.
#pragma once

#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace splinefeed::host {

/// In the language of man. @param command  one of the app's; "splinefeed": the page of all. Throws UsageError for
/// others.
[[nodiscard]] std::string man_page(const CLI::App& app, std::string_view command);

/// A script for bash to read.
[[nodiscard]] std::string bash_completion(const CLI::App& app);

} // namespace splinefeed::host
