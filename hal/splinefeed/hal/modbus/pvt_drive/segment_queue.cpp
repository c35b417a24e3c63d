// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/pvt_drive/segment_queue.hpp"

namespace splinefeed::hal::modbus {

void SegmentQueue::begin(std::uint32_t first) noexcept {
    origin_ = executed_ = front_ = next_ = first;
    rests_ = 0;
    ticks_ = 0;
}

bool SegmentQueue::is_executable(const Segment& segment) const noexcept {
    if (segment.duration_ticks < pvt::shortest_ticks || segment.duration_ticks > pvt::longest_ticks) {
        return false;
    }
    for (unsigned k = 0; segment.rest && k < static_cast<unsigned>(axes_); ++k) {
        if (segment.end_velocity[k] != 0) {
            return false;
        }
    }
    return true;
}

SegmentQueue::Refusal SegmentQueue::take(std::uint32_t first, std::span<const Segment> segments) noexcept {
    const auto known = static_cast<std::int32_t>(next_ - first); // so many of them were accepted already
    if (segments.empty()) {
        return Refusal::none; // and of nothing there is no first
    }
    if (known < 0) {
        return Refusal::gap;
    }
    if (static_cast<std::size_t>(known) >= segments.size()) {
        return Refusal::none;
    }
    const std::span<const Segment> fresh = segments.subspan(static_cast<std::size_t>(known));
    if (fresh.size() > free()) {
        return Refusal::no_room;
    }
    for (const Segment& segment : fresh) {
        if (!is_executable(segment)) {
            return Refusal::malformed;
        }
    }
    for (const Segment& segment : fresh) {
        segment_[(next_ - origin_) % segment_.size()] = segment;
        ++next_;
        ticks_ += segment.duration_ticks;
        rests_ += segment.rest ? 1U : 0U;
    }
    return Refusal::none;
}

SegmentQueue::Left SegmentQueue::left_before(std::uint32_t sequence, bool begun) const noexcept {
    const std::uint32_t least = begun ? front_ + 1 : front_;
    Left left{next_, ticks_, false};
    std::uint32_t rests = rests_;
    while (left.end != least && static_cast<std::int32_t>(left.end - sequence) > 0) {
        const Segment& dropped = at(--left.end);
        left.ticks -= dropped.duration_ticks;
        rests -= dropped.rest ? 1U : 0U;
    }
    left.rests = rests > 0;
    return left;
}

void SegmentQueue::drop_from(const Left& left) noexcept {
    while (next_ != left.end) {
        const Segment& dropped = at(--next_);
        ticks_ -= dropped.duration_ticks;
        rests_ -= dropped.rest ? 1U : 0U;
    }
}

void SegmentQueue::pass() noexcept {
    const Segment& passed = front();
    ticks_ -= passed.duration_ticks;
    rests_ -= passed.rest ? 1U : 0U;
    ++front_;
    // Places count from 0 again now and then, long before their number wraps.
    const auto turns = static_cast<std::uint32_t>(segment_.size());
    if (executed_ - origin_ >= turns) {
        origin_ += turns;
    }
}

} // namespace splinefeed::hal::modbus
