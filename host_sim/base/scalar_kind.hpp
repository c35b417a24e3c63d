// SPDX-License-Identifier: MIT
// ScalarKind: the number type of the core, as --scalar names it: fixed, float, double.
#pragma once

namespace splinefeed::host {

enum class ScalarKind { fixed, float32, float64 };

} // namespace splinefeed::host
