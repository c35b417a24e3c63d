// SPDX-License-Identifier: MIT
// schema_command: the command `splinefeed schema`: what a file may hold, for editors and checkers.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace splinefeed::host {

/// The files that have a schema.
[[nodiscard]] std::span<const std::string_view> schema_names();

/// The JSON schema of a file, with a line end. Throws UsageError for other names.
[[nodiscard]] std::string json_schema(std::string_view name);

} // namespace splinefeed::host
