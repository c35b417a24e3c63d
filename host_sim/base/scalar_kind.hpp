// SPDX-License-Identifier: MIT
// ScalarKind: what the core computes in, as --scalar names it: fixed, float, double.
#pragma once

namespace splinefeed::host {

enum class ScalarKind { fixed, float32, float64 };

} // namespace splinefeed::host
