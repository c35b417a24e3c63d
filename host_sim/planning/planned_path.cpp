// SPDX-License-Identifier: MIT
#include "host_sim/planning/planned_path.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/interruption.hpp"
#include "host_sim/base/number_text.hpp"
#include "host_sim/planning/scalar_path.hpp"

#include "splinefeed/number/path_position.hpp"

namespace splinefeed::host {

namespace {

constexpr int most_answers = 100; // that are taken for granted before a run

template <Scalar S>
std::optional<std::uint64_t> look(PathInput& input, CurveWatch& watch) {
    ScalarPath<S> path(input, nullptr, watch, {});
    PathFeeder& feeder = path.feeder();
    CurveSegment<S> segment;
    int answers = 0;
    for (Pull pull = Pull::starved; pull != Pull::finished && answers <= most_answers;
         pull = path.tee().next(segment)) {
        Interruption::point();
        PathFeeder::Pushed ignored;
        if (pull == Pull::starved && feeder.awaits_answer()) {
            feeder.program()->answer(feeder.program()->expected_answer());
            ++answers;
        }
        if (pull == Pull::starved) {
            path.go_on();
            static_cast<void>(feeder.more(ignored));
        }
    }
    if (path.tee().failure()) {
        std::rethrow_exception(path.tee().failure());
    }
    return answers == 0 ? std::optional(feeder.rows()) : std::nullopt;
}

template <Scalar S>
std::unique_ptr<PlannedPath> plan(PathInput& input, const MachineDescription& machine, CurveWatch& watch,
                                  const PlannerChoice& choice) {
    return std::make_unique<PlannedPath>(std::make_shared<ScalarPath<S>>(input, &machine, watch, choice));
}

} // namespace

template <Scalar S>
PlannedPath::Statistics ScalarPath<S>::statistics() const {
    PlannedPath::Statistics out;
    const Trajectory<S>& trajectory = stream_->trajectory();
    out.scalar = scalar_name<S>();
    out.jerk_scalar = planner_->jerk_scalar();
    out.length_mm = length_to_mm(trajectory.arc_length().travelled());
    out.curve_segments = tee_.segments();
    if (!curve_) {
        out.counts = stream_->counts();
    }
    out.window_limited = trajectory.feed_plan().window_limited();
    for (const unsigned k : indices(limits_->axes)) {
        out.jerk_mm_s3[k] = to_double(limits_->jerk_mm_s3[k]);
    }
    planner_->visit_jerk([&](const auto& plan) {
        out.searched_legs = plan.searched_legs();
        out.slow_legs = plan.slow_legs();
        out.window_limited = plan.window_limited(); // that of the plan which it refines says nothing
    });
    out.curve_bytes = curve_ ? curve_->bytes() : sizeof(TolerancePath<S>);
    out.plan_bytes = planner_->bytes();
    out.stream_bytes = sizeof(SegmentStream<S>);
    return out;
}

Pull PlannedPath::next(FeedSegment& out, Supply supply) {
    Interruption::point();
    const Pull pull = stream_->next(out, stream_->early(supply), WorkBudget::unlimited);
    if (pull == Pull::item) {
        out.waypoint = feeder_->row_of(out.waypoint);
    }
    return pull;
}

std::size_t read_window(std::string_view text) {
    const auto cells = read_whole<std::size_t>(text, 10, longest_window);
    if (!cells) {
        throw UsageError("--window {}: it must be a whole number from 10 to {}", in_quotes(text), longest_window);
    }
    return *cells;
}

std::unique_ptr<PlannedPath> plan_path(PathInput& input, const MachineDescription& machine, CurveWatch& watch,
                                       const PlannerChoice& choice) {
    switch (input.scalar()) {
    case ScalarKind::fixed: return plan<Fixed>(input, machine, watch, choice);
    case ScalarKind::float32: return plan<float>(input, machine, watch, choice);
    case ScalarKind::float64: break;
    }
    return plan<double>(input, machine, watch, choice);
}

std::optional<std::uint64_t> look_through(PathInput& input, CurveWatch& watch) {
    switch (input.scalar()) {
    case ScalarKind::fixed: return look<Fixed>(input, watch);
    case ScalarKind::float32: return look<float>(input, watch);
    case ScalarKind::float64: break;
    }
    return look<double>(input, watch);
}

} // namespace splinefeed::host
