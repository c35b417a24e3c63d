// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/problem_list.hpp"

namespace splinefeed::host {

bool ProblemList::add(const InputError& error) {
    if (into_ == nullptr) {
        throw error;
    }
    const bool is_new = known_.emplace(error.what()).second;
    if (is_new) {
        into_->emplace_back(error.what());
    }
    return is_new;
}

} // namespace splinefeed::host
