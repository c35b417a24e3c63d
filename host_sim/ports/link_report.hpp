// SPDX-License-Identifier: MIT
// LinkReport: what `splinefeed link` says of a target.
#pragma once

#include <string>

namespace splinefeed::host {

struct LinkReport {
    std::string text;    ///< lines for standard output
    std::string trouble; ///< why the machine cannot run as it stands, and the way out; empty: it can
};

} // namespace splinefeed::host
