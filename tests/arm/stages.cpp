// SPDX-License-Identifier: MIT
// What each stage of the pipeline costs on a microcontroller, and a hash over the feed segments, which the host must
// print, too. QEMU runs it with -icount shift=4: then instructions_now() counts in 64 instructions, and a call may take
// 42 million.
#include "instructions.hpp"
#include "segment_hash.hpp"
#include "splinefeed/acceleration_planner.hpp"
#include "splinefeed/jerk_planner.hpp"
#include "splinefeed/s1_curve/g2_spline.hpp"
#include "splinefeed/trajectory.hpp"
#include "write_number.hpp"
#include "write_value.hpp"

#include <array>
#include <new>

using namespace splinefeed;

namespace {

constexpr unsigned waypoints = 400;
constexpr std::uint32_t instructions_a_count = 64;
constexpr std::size_t window_cells = 52;
constexpr std::size_t jerk_cells = 100; // of the plan with a jerk limit
constexpr unsigned work_a_call = 4;     // as in examples/firmware

constexpr MachineSettings machine(bool jerk_limited) {
    MachineSettings settings;
    settings.axes = 3;
    settings.max_feed_mm_s = 80.0;
    settings.axis[2].max_velocity_mm_s = 40.0;
    settings.axis[2].max_acceleration_mm_s2 = 500.0;
    settings.axis[2].steps_per_mm = 400.0;
    if (jerk_limited) {
        for (AxisSettings& axis : settings.axis) {
            axis.max_jerk_mm_s3 = 40000.0;
        }
    }
    return settings;
}
template <bool jerk_limited>
constexpr auto limits = MotionLimits<Fixed>::make(machine(jerk_limited));
static_assert(limits<false>.has_value() && limits<true>.has_value());

/// A helix, 1.25 mm from one waypoint to the next, whose points lie up to 30 um beside it.
class NoisyHelix {
public:
    Waypoint<Fixed> next() {
        x_ -= y_ >> 4;
        y_ += x_ >> 4;
        z_ += 100;
        Waypoint<Fixed> waypoint;
        waypoint.position[0] = position_from_um(x_ + noise());
        waypoint.position[1] = position_from_um(y_ + noise());
        waypoint.position[2] = position_from_um(z_ + noise());
        return waypoint;
    }

private:
    std::int64_t noise() {
        random_ = random_ * 1664525U + 1013904223U;
        return static_cast<std::int64_t>(random_ >> 16) % 61 - 30;
    }

    std::int64_t x_ = 20000;
    std::int64_t y_ = 0;
    std::int64_t z_ = 0;
    std::uint32_t random_ = 1;
};

/// Built anew for each measurement, in memory that is not on the stack.
template <class T, int which = 0>
class Static {
public:
    template <class... Arguments>
    static T& build(Arguments&&... arguments) {
        return *::new (static_cast<void*>(bytes_)) T(static_cast<Arguments&&>(arguments)...);
    }

private:
    alignas(T) static inline unsigned char bytes_[sizeof(T)];
};

/// A stage is the last one of those that run.
struct Work {
    std::uint32_t counts = 0;
    std::uint32_t most = 0; ///< in one call
    unsigned items = 0;
};

/// Pulls until the end; `next` is the function of the last stage. What is done with an item is not counted.
template <class Next, class Use>
[[gnu::noinline]] Work pull(G2Spline<Fixed>& curve, Next&& next, Use&& use) {
    NoisyHelix helix;
    Work work;
    unsigned pushed = 0;
    for (;;) {
        const std::uint32_t before = instructions_now();
        const Pull pull = next();
        const std::uint32_t took = instructions_now() - before;
        work.counts += took;
        work.most = took > work.most ? took : work.most;
        if (pull == Pull::finished) {
            return work;
        }
        if (pull == Pull::item) {
            ++work.items;
            use();
            continue;
        }
        if (pull == Pull::busy) {
            continue;
        }
        while (pushed < waypoints && curve.has_room()) {
            const Waypoint<Fixed> waypoint = helix.next();
            const std::uint32_t start = instructions_now();
            static_cast<void>(curve.push(waypoint));
            work.counts += instructions_now() - start;
            ++pushed;
        }
        if (pushed == waypoints) {
            static_cast<void>(curve.finish());
        }
    }
}

[[gnu::noinline]] void write_cost(const char* name, std::uint32_t counts, unsigned items) {
    write_text("cost ");
    write_text(name);
    write_text(" ");
    write_number(static_cast<std::uint32_t>((static_cast<std::uint64_t>(counts) * instructions_a_count + items / 2) /
                                            (items == 0 ? 1U : items)));
    write_text(" instructions\n");
}

using Window = std::array<PlannedCell<Fixed>, window_cells>;

/// @return what all stages before the stream cost
std::uint32_t write_stages() {
    const auto ignore = [] {
    };
    CurveSegment<Fixed>& segment = Static<CurveSegment<Fixed>>::build();
    auto& curve = Static<G2Spline<Fixed>>::build(CurveOptions<Fixed>{});
    const Work pieces = pull(
        curve, [&] { return curve.next(segment); }, ignore);
    write_cost("curve_waypoint", pieces.counts, waypoints);
    write_cost("curve_longest_call", pieces.most, 1);

    auto& curve2 = Static<G2Spline<Fixed>>::build(CurveOptions<Fixed>{});
    auto& cell = Static<Cell<Fixed>>::build();
    auto& arc_length = Static<ArcLength<Fixed>>::build(curve2, limits<false>->refinement);
    const Work cells = pull(
        curve2, [&] { return arc_length.next(cell); }, ignore);
    write_cost("cell", cells.counts - pieces.counts, cells.items);
    write_cost("cell_longest_call", cells.most, 1);

    auto& curve3 = Static<G2Spline<Fixed>>::build(CurveOptions<Fixed>{});
    auto& arc_length2 = Static<ArcLength<Fixed>>::build(curve3, limits<false>->refinement);
    auto& plan = Static<FeedPlan<Fixed>>::build(arc_length2, *limits<false>, Static<Window>::build());
    const Work nodes = pull(
        curve3,
        [&] {
            const Pull pull = plan.prepare();
            if (pull == Pull::item) {
                plan.advance();
            }
            return pull;
        },
        ignore);
    write_cost("node", nodes.counts - cells.counts, cells.items);
    write_cost("node_longest_call", nodes.most, 1);
    return nodes.counts;
}

template <bool jerk_limited>
Trajectory<Fixed> make_trajectory(G2Spline<Fixed>& curve) {
    Window& window = Static<Window>::build();
    if constexpr (jerk_limited) {
        const JerkStorage<Fixed, float> storage{Static<std::array<Cell<Fixed>, jerk_cells>>::build(),
                                                Static<std::array<JerkNode<float>, jerk_cells + 1>>::build(),
                                                Static<std::array<LegNode<float>, jerk_cells + 1>>::build()};
        return *Trajectory<Fixed>::make(curve, *limits<jerk_limited>,
                                        Static<JerkPlanner<Fixed, float>>::build(window, storage));
    } else {
        return *Trajectory<Fixed>::make(curve, *limits<jerk_limited>,
                                        Static<AccelerationPlanner<Fixed>>::build(window));
    }
}

/// The same motion, planned in as small parts as the reference firmware plans it.
void write_parts() {
    auto& curve = Static<G2Spline<Fixed>>::build(CurveOptions<Fixed>{});
    Trajectory<Fixed> trajectory = make_trajectory<false>(curve);
    FeedSegment& segment = Static<FeedSegment>::build();
    SegmentHash hash;
    const Work work = pull(
        curve, [&] { return trajectory.next(segment, UnderrunPolicy::wait, work_a_call); }, [&] { hash.add(segment); });
    write_cost("parts_waypoint", work.counts, waypoints);
    write_cost("parts_longest_call", work.most, 1);
    write_value("parts hash", hash.value());
}

template <bool jerk_limited>
void write_pipeline(std::uint32_t before_stream) {
    auto& curve = Static<G2Spline<Fixed>>::build(CurveOptions<Fixed>{});
    Trajectory<Fixed> trajectory = make_trajectory<jerk_limited>(curve);
    FeedSegment& segment = Static<FeedSegment>::build();
    SegmentHash hash;
    // With limited jerk in parts: all of a window at once may take more than is counted.
    const unsigned work_of_call = jerk_limited ? work_a_call : WorkBudget::unlimited;
    const Work work = pull(
        curve, [&] { return trajectory.next(segment, UnderrunPolicy::wait, work_of_call); },
        [&] { hash.add(segment); });
    write_cost(jerk_limited ? "jerk_waypoint" : "pipeline_waypoint", work.counts, waypoints);
    write_cost(jerk_limited ? "jerk_feed_segment" : "pipeline_feed_segment", work.counts, work.items);
    if (!jerk_limited) {
        write_cost("stream_segment", work.counts - before_stream, work.items);
    }
    write_cost(jerk_limited ? "jerk_longest_call" : "pipeline_longest_call", work.most, 1);
    write_value(jerk_limited ? "jerk segments" : "segments", work.items);
    write_value(jerk_limited ? "jerk hash" : "hash", hash.value());
}

} // namespace

int main() {
    start_counting();
    const std::uint32_t before_stream = write_stages();
    write_pipeline<false>(before_stream);
    write_parts();
    write_pipeline<true>(before_stream);
    return 0;
}
