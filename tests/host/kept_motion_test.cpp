// SPDX-License-Identifier: MIT
#include "host_sim/run/kept_motion.hpp"

#include "refusal.hpp"

#include "support/catch.hpp"

#include <random>
#include <stdexcept>
#include <vector>

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

/// Segments that meet, of so many axes.
std::vector<FeedSegment> chain(std::size_t count, unsigned axes) {
    std::mt19937_64 random(1);
    std::vector<FeedSegment> out(count);
    for (std::size_t i = 0; i < count; ++i) {
        FeedSegment& segment = out[i];
        segment.index = 7 + i;
        segment.duration_ticks = 8000;
        segment.waypoint = static_cast<std::uint32_t>(random());
        for (unsigned k = 0; k < axes; ++k) {
            segment.start[k] = i > 0 ? out[i - 1].end[k] : static_cast<std::int64_t>(random());
            segment.start_velocity[k] = i > 0 ? out[i - 1].end_velocity[k] : static_cast<std::int64_t>(random());
            segment.end[k] = static_cast<std::int64_t>(random());
            segment.end_velocity[k] = static_cast<std::int64_t>(random());
        }
    }
    return out;
}

} // namespace

TEST_CASE("the segments that a motion keeps are those that it was given") {
    for (const int axes : {1, 3, max_axes}) {
        const std::vector<FeedSegment> all = chain(5000, static_cast<unsigned>(axes));
        KeptMotion kept(axes);
        for (std::size_t i = 0; i < all.size(); ++i) {
            kept.add(all[i], i, {LimitKind::jerk, 1});
        }
        REQUIRE(kept.size() == all.size());
        CHECK(kept.segment_ticks() == 8000);
        for (std::size_t i = 0; i < all.size(); ++i) {
            const FeedSegment segment = kept.segment(i);
            REQUIRE(segment.index == all[i].index);
            REQUIRE(segment.duration_ticks == all[i].duration_ticks);
            REQUIRE(segment.waypoint == all[i].waypoint);
            REQUIRE(segment.start == all[i].start);
            REQUIRE(segment.end == all[i].end);
            REQUIRE(segment.start_velocity == all[i].start_velocity);
            REQUIRE(segment.end_velocity == all[i].end_velocity);
        }
    }
}

TEST_CASE("a motion keeps no segment that does not begin as the one before ends") {
    const std::vector<FeedSegment> all = chain(2, 2);
    const auto refused = [&](void (*change)(FeedSegment&)) {
        KeptMotion kept(2);
        kept.add(all[0], 1, {});
        FeedSegment second = all[1];
        change(second);
        return splinefeed_test::refusal_of<std::logic_error>([&] { kept.add(second, 2, {}); });
    };
    CHECK(refused([](FeedSegment&) {}) == "accepted");
    CHECK(refused([](FeedSegment& s) { ++s.start[1]; }) == "a segment does not begin as the one before ends");
    CHECK(refused([](FeedSegment& s) { ++s.start_velocity[0]; }) != "accepted");
    CHECK(refused([](FeedSegment& s) { ++s.duration_ticks; }) != "accepted");
    CHECK(refused([](FeedSegment& s) { ++s.index; }) != "accepted");
}
