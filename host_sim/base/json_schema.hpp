// SPDX-License-Identifier: MIT
// json_schema: the JSON schema of a file, made of the rows that its reader checks by.
#pragma once

#include "host_sim/base/file_key.hpp"

#include <nlohmann/json_fwd.hpp>

namespace splinefeed::host {

/// A table of these keys and no others, in draft 7, which editors know. What only the reader can say is not in it:
/// values that depend on other values, on another file, or on names.
[[nodiscard]] nlohmann::ordered_json schema_of(const FileTable& table);
/// The value of a key.
[[nodiscard]] nlohmann::ordered_json schema_of(const FileKey& row);
/// The same of a value whose schema is known.
[[nodiscard]] nlohmann::ordered_json described(const FileKey& row, nlohmann::ordered_json value);

} // namespace splinefeed::host
