// SPDX-License-Identifier: MIT
// ParameterInterval: the part of a curve's own parameter that a piece covers.
#pragma once

namespace splinefeed::host {

struct ParameterInterval {
    double from = 0.0;
    double to = 1.0;
};

} // namespace splinefeed::host
