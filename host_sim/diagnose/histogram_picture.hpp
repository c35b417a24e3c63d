// SPDX-License-Identifier: MIT
// histogram_picture: a histogram of times as text.
#pragma once

#include "splinefeed/hal/rt/time_histogram.hpp"

#include <string>

namespace splinefeed::host {

/// A line for each bin that has any, with a bar; empty where there is none.
[[nodiscard]] std::string histogram_picture(const hal::TimeHistogram& times);

} // namespace splinefeed::host
