// SPDX-License-Identifier: MIT
// histogram_picture: a histogram of times as text.
#pragma once

#include "splinefeed/hal/rt/time_histogram.hpp"

#include <string>

namespace splinefeed::host {

inline constexpr double median_share = 0.5;
inline constexpr double nearly_all = 0.99;

/// One line with a bar for each bin that is not empty; an empty text if all bins are empty.
[[nodiscard]] std::string histogram_picture(const hal::TimeHistogram& times);

} // namespace splinefeed::host
