// SPDX-License-Identifier: MIT
#include "host_sim/base/file_key.hpp"

#include "splinefeed/base/assertion.hpp"

#include <algorithm>

namespace splinefeed::host {

const FileKey& FileTable::row(std::string_view key) const {
    const auto found = std::ranges::find(keys, key, &FileKey::key);
    SPLINEFEED_ASSERT(found != keys.end());
    return *found;
}

} // namespace splinefeed::host
