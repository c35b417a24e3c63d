// SPDX-License-Identifier: MIT
//
// Reverse run: back along the path, and forward again.
//
// The machine turns where it stands, and what it travels then is a motion of its own, from there along the curve that
// KeptCurve has of the path. So all limits, feeds and overrides are those of the way forward.
#include "tp_motion.hpp"

namespace splinefeed::linuxcnc {

namespace {

constexpr unsigned most_entered = 64; // moves, in a period

} // namespace

// Whether it has to brake for that. Where a path has not begun, there is no way back.
bool TpMotion::turns_round(bool backward) noexcept {
    if (backward == backs()) {
        return false;
    }
    if (!has_now_ || !stands()) {
        return true;
    }
    front_ = static_cast<int>(first_ - front_) > 0 ? first_ : front_;
    curve_.turn(stream_->trajectory().position(), now_.waypoint, backward, front_ - base_ - tpc_kept);
    stream_->turn();
    state_ = backward ? State::backs : State::path;
    return false;
}

// As come_to(): a move is left where the machine passes the plane through its start.
void TpMotion::come_back_to(std::uint32_t piece, const Mm& at) noexcept {
    const unsigned last = base_ + curve_.move_of(piece) + 1U;
    const unsigned least = base_ + curve_.move_before(piece);
    first_ = static_cast<int>(first_ - last) > 0 ? last : first_;
    for (unsigned i = 0;
         i < most_entered && first_ != begun_ && static_cast<int>(first_ - least) > 0 && is_before_end(first_ - 1U, at);
         ++i) {
        --first_;
        turning_ = first_;
        turns_left_rad_ = 0.0; // an arc is entered at its end
    }
    turn(at);
    floor_ = first_;
    piece_ = last - 1U;
    neared_ = first_ - 1U;
}

} // namespace splinefeed::linuxcnc
