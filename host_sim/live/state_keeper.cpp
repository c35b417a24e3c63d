// SPDX-License-Identifier: MIT
#include "host_sim/live/state_keeper.hpp"

#include "host_sim/base/durable_file.hpp"
#include "host_sim/base/text_file.hpp"

#include <algorithm>

namespace splinefeed::host {

namespace {

constexpr std::size_t largest_state = 1U << 16U;
constexpr const char* run_has_no_end =
    "a run has not ended, or its process was killed before it could say where the machine stands";
constexpr const char* end_without_place =
    "when the last run ended, this axis had no reference or had not confirmed that it stands";

} // namespace

StateKeeper::StateKeeper(std::string file, std::vector<std::string> axes, MachineState begins)
    : file_(std::move(file)), axes_(std::move(axes)), kept_(std::move(begins)) {}

void StateKeeper::write() {
    write_state_file(file_, axes_, kept_);
}

void StateKeeper::moves() {
    const std::lock_guard lock(mutex_);
    if (is_regular_file(file_)) {
        before_ = read_text_file(file_, largest_state);
    }
    moves_ = true;
    kept_.position_mm.fill(std::nullopt);
    kept_.unknown_why = run_has_no_end;
    write();
}

void StateKeeper::offsets(const WorkOffsets& offsets) {
    const std::lock_guard lock(mutex_);
    kept_.offsets = offsets;
    write();
}

void StateKeeper::stands(const PerAxis<double>& mm) {
    const std::lock_guard lock(mutex_);
    std::ranges::copy(mm, kept_.position_mm.begin());
    kept_.unknown_why.clear();
    write();
}

void StateKeeper::ends(std::span<const RunTarget::AxisPlace> places) {
    const std::lock_guard lock(mutex_);
    if (!places.empty()) {
        for (const RunTarget::AxisPlace& at : places) {
            kept_.position_mm[at.axis] = at.known();
        }
        kept_.unknown_why = end_without_place;
        write();
    } else if (before_) {
        replace_durably(file_, *before_);
    } else if (moves_) {
        remove_replaced(file_);
    }
}

} // namespace splinefeed::host
