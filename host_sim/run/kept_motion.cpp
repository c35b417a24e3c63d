// SPDX-License-Identifier: MIT
#include "host_sim/run/kept_motion.hpp"

#include <cstdlib>
#include <cstring>
#include <new>
#include <stdexcept>

namespace splinefeed::host {

namespace {

constexpr std::size_t first_room = 1024;

} // namespace

void KeptMotion::Free::operator()(std::byte* bytes) const noexcept {
    std::free(bytes); // NOLINT: of realloc, which moves pages where a vector would copy
}

void KeptMotion::grow() {
    const std::size_t room = room_ > 0 ? 2 * room_ : first_room;
    auto* const bytes = static_cast<std::byte*>(std::realloc(bytes_.get(), room * record_)); // NOLINT: as above
    if (bytes == nullptr) {
        throw std::bad_alloc();
    }
    static_cast<void>(bytes_.release());
    bytes_.reset(bytes);
    room_ = room;
}

void KeptMotion::add(const FeedSegment& segment, std::uint64_t row, BindingLimit limit) {
    if (size_ == 0) {
        first_ = segment;
    } else if (segment.start != last_.end || segment.start_velocity != last_.end_velocity ||
               segment.duration_ticks != first_.duration_ticks || segment.index != last_.index + 1) {
        throw std::logic_error("a segment does not begin as the one before ends");
    }
    if (size_ == room_) {
        grow();
    }
    std::byte* const out = bytes_.get() + size_ * record_;
    const Head head{segment.waypoint, static_cast<std::uint32_t>(row), limit.code()};
    const std::size_t axes_bytes = axes_ * sizeof(std::int64_t);
    std::memcpy(out, &head, sizeof head);
    std::memcpy(out + sizeof head, segment.end.data(), axes_bytes);
    std::memcpy(out + sizeof head + axes_bytes, segment.end_velocity.data(), axes_bytes);
    last_ = segment;
    ++size_;
}

void KeptMotion::read_end(std::size_t i, PerAxis<std::int64_t>& end, PerAxis<std::int64_t>& velocity) const noexcept {
    const std::byte* const in = bytes_.get() + i * record_ + sizeof(Head);
    const std::size_t axes_bytes = axes_ * sizeof(std::int64_t);
    std::memcpy(end.data(), in, axes_bytes);
    std::memcpy(velocity.data(), in + axes_bytes, axes_bytes);
}

FeedSegment KeptMotion::segment(std::size_t i) const noexcept {
    FeedSegment out = first_;
    out.index = first_.index + i;
    std::memcpy(&out.waypoint, bytes_.get() + i * record_ + offsetof(Head, waypoint), sizeof out.waypoint);
    if (i > 0) {
        read_end(i - 1, out.start, out.start_velocity);
    }
    read_end(i, out.end, out.end_velocity);
    return out;
}

} // namespace splinefeed::host
