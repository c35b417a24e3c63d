// SPDX-License-Identifier: MIT
#include "host_sim/ports/stop_sentence.hpp"

#include <algorithm>

namespace splinefeed::host {

using hal::StopRequest;
using hal::StopState;

std::string unconfirmed_drives(const std::vector<StoppedDrive>& drives) {
    std::string text;
    for (const StoppedDrive& drive : drives) {
        if (drive.report.request != StopRequest::none && drive.report.state != StopState::confirmed) {
            text += "; " + drive.name + " did not confirm its stop and may still move";
        }
    }
    return text;
}

std::string not_switched_off(const std::vector<StoppedDrive>& drives) {
    std::string text;
    for (const StoppedDrive& drive : drives) {
        if (drive.report.request != StopRequest::disable || drive.report.state != StopState::confirmed) {
            text += std::string(text.empty() ? "" : "; ") + drive.name + " did not confirm that it is off";
        }
    }
    return text;
}

std::string stop_sentence(const std::vector<StoppedDrive>& drives, bool twice) {
    const std::string begin = twice ? "interrupted twice: " : "interrupted: ";
    if (const std::string missing = unconfirmed_drives(drives); !missing.empty()) {
        return begin + missing.substr(2);
    }
    if (std::ranges::all_of(drives, [](const StoppedDrive& drive) { return drive.report.held(); })) {
        return begin + "all drives were held on the path";
    }
    std::string text = begin + "all axes stopped, each for itself";
    for (const StoppedDrive& drive : drives) {
        if (!twice && drive.report.request > StopRequest::hold) {
            text += "; " + drive.name + " did not hold in time and got a " + name(drive.report.request);
        }
    }
    return text;
}

} // namespace splinefeed::host
