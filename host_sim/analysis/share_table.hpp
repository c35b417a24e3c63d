// SPDX-License-Identifier: MIT
// share_table: the shares of the limits as text.
#pragma once

#include "host_sim/analysis/limit_share.hpp"

#include <string>

namespace splinefeed::host {

/// One row per axis and one per limit of the path, in percent of the time; each ends with a line end.
/// @param names  names of the axes, as many as there are in `shares`
[[nodiscard]] std::string share_table(const std::vector<std::string>& names, const LimitShares& shares);

} // namespace splinefeed::host
