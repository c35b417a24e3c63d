// SPDX-License-Identifier: MIT
// stop_sentence: the message about drives that were stopped. It claims only what is known.
#pragma once

#include "splinefeed/hal/stop_sequence.hpp"

#include <string>
#include <vector>

namespace splinefeed::host {

struct StoppedDrive {
    std::string name; ///< as the user wrote it
    hal::StopReport report;
};

/// "interrupted: all drives were held on the path" if that is known, otherwise what is known instead.
[[nodiscard]] std::string stop_sentence(const std::vector<StoppedDrive>& drives, bool twice);

/// "; NAME did not confirm its stop and may still move", for each such drive; empty: there is none.
[[nodiscard]] std::string unconfirmed_drives(const std::vector<StoppedDrive>& drives);

/// "NAME did not confirm that it is off; ...", for each such drive; empty: there is none.
[[nodiscard]] std::string not_switched_off(const std::vector<StoppedDrive>& drives);

} // namespace splinefeed::host
