// SPDX-License-Identifier: MIT
// ScalarKind: what the core computes in, as --scalar names it: fixed, float, double.
#pragma once

namespace splinefeed::host {

enum class ScalarKind { fixed, single, dual };

} // namespace splinefeed::host
