// SPDX-License-Identifier: MIT
#include "host_sim/drive/axis_moves.hpp"

namespace splinefeed::host {

void AxisMoves::stop(const PvtReference& from, std::span<const PvtAxisParameters> axes) noexcept {
    axes_ = axes.size();
    passed_s_ = 0.0;
    for (std::size_t k = 0; k < axes_; ++k) {
        moves_[k] = AxisMove::stop({from.counts[k], from.counts_s[k]}, axes[k].stop_counts_s2);
    }
}

void AxisMoves::home(const PvtReference& from, std::span<const PvtAxisParameters> axes) noexcept {
    axes_ = axes.size();
    passed_s_ = 0.0;
    for (std::size_t k = 0; k < axes_; ++k) {
        moves_[k] = AxisMove::to(from.counts[k], 0.0, axes[k].homing_counts_s, axes[k].homing_counts_s2);
    }
}

bool AxisMoves::pass(double duration_s, PvtReference& reference) noexcept {
    passed_s_ += duration_s;
    bool arrived = true;
    for (std::size_t k = 0; k < axes_; ++k) {
        const AxisMove::State at = moves_[k].at(passed_s_);
        reference.counts[k] = at.position;
        reference.counts_s[k] = at.velocity;
        arrived = arrived && passed_s_ >= moves_[k].duration_s();
    }
    return arrived;
}

} // namespace splinefeed::host
