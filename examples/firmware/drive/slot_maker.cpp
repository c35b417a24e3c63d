// SPDX-License-Identifier: MIT
#include "drive/slot_maker.hpp"

namespace firmware {

namespace {

constexpr std::int64_t microseconds = 1'000'000;
/// A sixteenth above the largest speed, for a host whose clock differs, and below half a step a tick.
constexpr std::int64_t largest = splinefeed::units_per_count * drive_steps_per_s / microseconds * slot_us * 17 / 16;
static_assert(largest < splinefeed::units_per_count * slot_us / drive_tick_us / 2, "TickDda: below half a step a tick");

constexpr bool is_slow(std::int64_t velocity) noexcept {
    return velocity <= largest && velocity >= -largest;
}

} // namespace

void SlotMaker::stand_at(const PerAxis<std::int64_t>& position) noexcept {
    loader_ = splinefeed::DdaLoader(static_cast<int>(drive_axes), drive_tick_us * 8);
    reference_ = {position, {}};
}

std::optional<unsigned> SlotMaker::make(const AxisPlaces& to, bool rest, MotionPart& out) noexcept {
    splinefeed::FeedSegment slot;
    slot.duration_ticks = slot_ticks;
    for (unsigned k = 0; k < drive_axes; ++k) {
        const std::int64_t v0 = reference_.velocity[k];
        const std::int64_t v1 = rest ? 0 : to.velocity[k];
        const std::int64_t way = to.position[k] - reference_.position[k];
        // The velocity of a cubic lies between these three.
        if (!is_slow(v0) || !is_slow(v1) || !is_slow(3 * way - v0 - v1)) {
            return k;
        }
        slot.start[k] = reference_.position[k];
        slot.end[k] = to.position[k];
        slot.start_velocity[k] = v0;
        slot.end_velocity[k] = v1;
    }
    loader_.take(slot);
    static_cast<void>(loader_.next(out.ticks)); // a slot is one part
    out.end = loader_.end_count();
    out.rest = rest;
    reference_ = {slot.end, slot.end_velocity};
    return std::nullopt;
}

} // namespace firmware
