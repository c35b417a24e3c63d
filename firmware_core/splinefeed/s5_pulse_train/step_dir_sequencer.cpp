// SPDX-License-Identifier: MIT
//
// Why no step has to move. Steps in one direction are step_gap() apart, because the plan keeps the axis's velocity
// (StepTiming::allows). If a step p is followed by a step back s less than turn_gap() later, both belong to one
// crossing, which the motion passes and passes back. Without both steps the axis stands where it stood before p. The
// step e before p and the step n after s still fit together:
//   e and n both in the direction of p: they are one count apart, and n belongs to the same crossing as p but is later.
//   e as p, n as s: between e and n the motion goes out by more than a count and back; by allows() the time for 1/64
//   count out and back is longer than turn_gap().
//   e as s, n as p: the crossing of e is that of p, and e and p were far enough apart; n is a count beyond.
//   e and n both as s: n comes after s.
//
// A step is certain when a later step of its axis is known, or nothing within turn_gap() can follow. Its edges then
// wait until no later step of another axis can have an earlier edge, a change of direction: `setup` before that step.
#include "splinefeed/s5_pulse_train/step_dir_sequencer.hpp"

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/base/ring_index.hpp"

#include <limits>

namespace splinefeed {

void StepDirSequencer::push(const Step& step) noexcept {
    Lane& lane = lane_[step.axis];
    if (lane.size > 0) {
        const Waiting& last = lane.step[ring_index(lane.head + lane.size - 1, capacity)];
        const std::int64_t gap = step.tick - last.tick;
        SPLINEFEED_ASSERT(gap >= 0);
        if (last.up != step.up && gap < timing_.turn_gap()) {
            --lane.size;
            left_out_ += 2;
            return;
        }
        SPLINEFEED_ASSERT(gap >= timing_.step_gap()); // faster than allows() was asked for
    }
    SPLINEFEED_ASSERT(lane.size < capacity);
    lane.step[ring_index(lane.head + lane.size, capacity)] = {step.tick, step.up};
    ++lane.size;
}

/// Instant of the lane's next edge. @pre it has one
std::int64_t StepDirSequencer::due(const Lane& lane) const noexcept {
    if (lane.on) {
        return lane.fall;
    }
    const Waiting& step = lane.step[lane.head];
    return step.up != lane.up ? step.tick - timing_.setup : step.tick;
}

bool StepDirSequencer::next(Edge& out, std::int64_t known) noexcept {
    constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();
    std::int64_t first = never;
    unsigned axis = 0;
    for (unsigned k = 0; k < axes_; ++k) {
        const Lane& lane = lane_[k];
        if (lane.on || lane.size > 0) {
            const std::int64_t tick = due(lane);
            if (tick < first) {
                first = tick;
                axis = k;
            }
        }
    }
    Lane& lane = lane_[axis];
    const bool certain =
        known == never || (first <= known - timing_.setup &&
                           (lane.on || lane.size > 1 || lane.step[lane.head].tick <= known - timing_.turn_gap()));
    if (first == never || !certain) {
        return false;
    }
    out.tick = first;
    out.axis = static_cast<std::uint8_t>(axis);
    pass(lane, out);
    return true;
}

void StepDirSequencer::pass(Lane& lane, Edge& out) const noexcept {
    out.line = Line::step;
    if (lane.on) {
        lane.on = false;
        out.level = false;
        return;
    }
    const Waiting& step = lane.step[lane.head];
    if (step.up != lane.up) {
        lane.up = step.up;
        out.line = Line::direction;
        out.level = step.up;
        return;
    }
    lane.level = !lane.level;
    out.level = !timing_.step_on_edge || lane.level;
    lane.on = !timing_.step_on_edge;
    lane.fall = step.tick + timing_.high;
    lane.head = static_cast<unsigned>(ring_index(lane.head + 1, capacity));
    --lane.size;
}

} // namespace splinefeed
