// SPDX-License-Identifier: MIT
//
// Input that comes too late for a machine that cannot wait: it goes on with what is known, stops at its end, and starts
// again, all within the limits.
#include "support/catch.hpp"
#include "support/emitted.hpp"
#include "support/rounds.hpp"
#include "support/steered_run.hpp"

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 815;

/// Gives no more segments than were released.
template <Scalar S>
class GatedSource final : public CurveSource<S> {
public:
    GatedSource(ListSource<S>& list, std::size_t size) : list_(&list), size_(size) {}
    void release(std::size_t n) { released_ += n; }
    Pull next(CurveSegment<S>& out) noexcept override {
        if (given_ >= released_ && given_ < size_) {
            return Pull::starved;
        }
        const Pull pull = list_->next(out);
        given_ += pull == Pull::item ? 1U : 0U;
        return pull;
    }

private:
    ListSource<S>* list_;
    std::size_t size_;
    std::size_t released_ = 0;
    std::size_t given_ = 0;
};

} // namespace

TEMPLATE_TEST_CASE("late input is a controlled stop and a clean restart", "[stream][starvation]", double, float,
                   Fixed) {
    using S = TestType;
    int stops = 0;
    for (std::uint64_t round = 0; round < static_cast<std::uint64_t>(rounds(8)); ++round) {
        Random random(seed + round);
        const int axes = random.integer(1, max_axes);
        MachineSettings machine = random_machine(random, axes);
        for (AxisSettings& axis : machine.axis) {
            axis.max_acceleration_mm_s2 = random.decades(300.0, 3e4);
        }
        const auto limits = MotionLimits<S>::make(machine);
        if (!limits.has_value()) {
            continue;
        }
        const BezierPath path = random_path(random, axes, 20, random.decades(0.3, 20.0), 0.1, 0.3);
        const std::size_t window_size = random.chance(0.5) ? 16 : 256;
        const SteeredRun plain = run_steered<S>(path, machine, window_size, {});
        if (plain.endless || plain.segments.size() > 20'000) {
            continue;
        }
        ListSource<S> list(segments_of<S>(path, {}), 0, 0);
        GatedSource<S> source(list, path.size());
        std::vector<PlannedCell<S>> window(window_size);
        Trajectory<S> trajectory(source, *limits, window);
        SteeredRun run;
        FeedSegment segment;
        const double pace =
            random.decades(0.3, 3.0) * static_cast<double>(path.size()) / static_cast<double>(plain.segments.size());
        bool stood = true;
        CAPTURE(seed, round, window_size);
        while (run.segments.size() < 300'000) {
            if (random.chance(std::min(1.0, pace))) {
                source.release(static_cast<std::size_t>(random.integer(1, 3)));
            }
            if (trajectory.next(segment, Starvation::goes_on)) {
                stood = false;
            } else if (trajectory.state() == Pull::starved) {
                if (!run.segments.empty()) {
                    REQUIRE(ends_at_rest(run.segments.back(), static_cast<unsigned>(axes)));
                }
                stops += stood ? 0 : 1;
                stood = true;
                trajectory.stand(segment);
            } else {
                break;
            }
            run.segments.push_back(segment);
        }
        REQUIRE(trajectory.state() == Pull::finished);
        // Nothing is known of the start while the first segment is awaited: the machine stands at 0, as the path does
        require_limits(run, machine, std::same_as<S, float> ? 5e-2L : 0.0L);
        for (unsigned k = 0; k < static_cast<unsigned>(axes); ++k) {
            REQUIRE(run.segments.back().end[k] == plain.segments.back().end[k]);
        }
        const Track<S> track(path, machine);
        typename Track<S>::Place place;
        for (std::size_t i = 1; i < run.segments.size() && run.segments.size() < 6'000; ++i) {
            REQUIRE(track.find(run.segments[i], place) <= (std::same_as<S, float> ? 1e-4L : 1e-7L));
        }
    }
    CHECK(4 * stops >= rounds(8));
}
