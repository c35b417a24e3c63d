// SPDX-License-Identifier: MIT
#include "host_sim/target/program_outputs.hpp"

namespace splinefeed::host {

void ProgramOutputs::act(const ProgramAction& action) {
    if (action.spindle && spindle_ != nullptr) {
        spindle_->order(action.spindle->direction, action.spindle->rpm);
    }
    if (switches_ != nullptr && RunSwitches::is_of(action.kind)) {
        switches_->act(action.kind, action.number);
    }
}

void ProgramOutputs::end() {
    if (spindle_ != nullptr) {
        spindle_->end();
    }
    if (switches_ != nullptr) {
        switches_->end();
    }
}

std::string ProgramOutputs::trouble() const {
    std::string what = spindle_ != nullptr ? spindle_->trouble() : std::string();
    return what.empty() && switches_ != nullptr ? switches_->trouble() : what;
}

} // namespace splinefeed::host
