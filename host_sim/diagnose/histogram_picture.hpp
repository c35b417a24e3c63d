// SPDX-License-Identifier: MIT
// histogram_picture: a histogram of times as text.
#pragma once

#include "splinefeed/hal/rt/time_histogram.hpp"

#include <string>

namespace splinefeed::host {

/// One line with a bar for each bin that is not empty; an empty text if all bins are empty.
[[nodiscard]] std::string histogram_picture(const hal::TimeHistogram& times);

} // namespace splinefeed::host
