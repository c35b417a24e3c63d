// SPDX-License-Identifier: MIT
#include "host_sim/run/what_would_help.hpp"

#include "host_sim/analysis/limit_kind.hpp"
#include "host_sim/output/progress.hpp"
#include "host_sim/planning/planned_path.hpp"

#include "splinefeed/s3_feed_plan/limits/machine_numbers.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr double raised = 1.1;
constexpr std::size_t times_longer = 4;      // a window
constexpr std::uint64_t most_moves = 10'000; // of a program that are planned again
constexpr double may_bind = 0.85;            // of a limit: a plan that stays a little below it is bound by it

/// One limit, and the value of the machine that states it.
struct Candidate {
    BindingLimit limit;
    std::string name;
    double MachineSettings::*of_machine = nullptr;
    double AxisSettings::*of_axis = nullptr;
};

std::vector<Candidate> candidates(const MachineDescription& machine, const Summary& summary) {
    std::vector<Candidate> out;
    std::vector<std::string> names;
    for (const Summary::AxisUse& use : summary.limit_use) {
        names.push_back(use.axis);
    }
    const auto add = [&](BindingLimit limit, double MachineSettings::*of_machine, double AxisSettings::*of_axis) {
        out.push_back({limit, limit_name(limit, names), of_machine, of_axis});
    };
    const LimitShares shares = summary.limit_share.value_or(LimitShares{});
    if (shares.programmed_feed > 0.0) {
        add({LimitKind::feed}, nullptr, nullptr);
    }
    if (shares.feed > shares.programmed_feed + shares.override_feed) {
        add({LimitKind::machine_feed}, &MachineSettings::max_feed_mm_s, nullptr);
    }
    for (std::size_t k = 0; k < names.size(); ++k) {
        const Summary::AxisUse& use = summary.limit_use[k];
        const auto of = [k](LimitKind kind) {
            return BindingLimit{kind, static_cast<std::uint8_t>(k)};
        };
        if (use.velocity >= may_bind) {
            add(of(LimitKind::velocity), nullptr, &AxisSettings::max_velocity_mm_s);
        }
        if (use.acceleration >= may_bind) {
            add(of(LimitKind::acceleration), nullptr, &AxisSettings::max_acceleration_mm_s2);
        }
        if (use.acceleration >= may_bind && machine.settings.axis[k].max_braking_mm_s2 > 0.0) {
            out.push_back(
                {of(LimitKind::acceleration), "braking of " + names[k], nullptr, &AxisSettings::max_braking_mm_s2});
        }
        if (use.jerk.value_or(0.0) >= may_bind) {
            add(of(LimitKind::jerk), nullptr, &AxisSettings::max_jerk_mm_s3);
        }
    }
    if (shares.centripetal.value_or(0.0) > 0.0) {
        add({LimitKind::centripetal}, &MachineSettings::centripetal_mm_s2, nullptr);
    }
    if (shares.chord.value_or(0.0) > 0.0) {
        add({LimitKind::chord}, &MachineSettings::chord_error_mm, nullptr);
    }
    return out;
}

/// The raised value as --set states it; empty: it is no number of the machine.
std::string setting_of(const Candidate& candidate, const MachineDescription& machine) {
    for (const auto& number : path_numbers) {
        if (candidate.of_machine != nullptr && number.value == candidate.of_machine) {
            return fmt::format("path.{}={:.6g}", number.key, machine.settings.*number.value);
        }
    }
    for (const auto& number : axis_numbers) {
        if (candidate.of_axis != nullptr && number.value == candidate.of_axis) {
            return fmt::format("axis.{}.{}={:.6g}", machine.axis_name[candidate.limit.axis], number.key,
                               machine.settings.axis[candidate.limit.axis].*number.value);
        }
    }
    return {};
}

/// Nobody looks at a path that is only planned again.
class NoWatch final : public CurveWatch {
public:
    void segment(const CurveSegment<double>& /*segment*/, std::uint32_t /*row*/,
                 const PathFeeder& /*feeder*/) override {}
};

/// The motion alone, on a machine whose limits differ.
double planned_s(const HelpArguments& arguments, const RunMachine& machine, double feed_factor, std::uint64_t moves,
                 const PlannerChoice& planner) {
    PathArguments in_double = *arguments.path;
    in_double.scalar = ScalarKind::float64; // the fastest one: the time is the same within a segment
    PathInput input(in_double, PathUse::executed, machine.path());
    input.begin_at(*arguments.begins);
    input.end_after(moves);
    Progress progress({.quiet = arguments.quiet, .all = arguments.waypoints});
    NoWatch nobody;
    const auto path = plan_path(input, machine.machine, nobody, planner);
    PathFeeder& feeder = path->feeder();
    path->stream().override_feed(Fixed::from_double(feed_factor));
    std::uint64_t ticks = 0;
    std::optional<std::uint32_t> row;
    FeedSegment segment;
    for (Pull pull = Pull::starved; pull != Pull::finished; pull = path->next(segment, Supply::flows)) {
        if (pull == Pull::item) {
            ticks += segment.duration_ticks;
            if (row != segment.waypoint) {
                row = segment.waypoint;
                feeder.passed(*row);
            }
            if (progress.due()) {
                progress.show({feeder.rows(), 0, static_cast<double>(ticks) / (ticks_per_us * 1e6)});
            }
            continue;
        }
        PathFeeder::Pushed ignored;
        if (feeder.awaits_answer()) {
            feeder.program()->answer(feeder.program()->expected_answer());
        }
        path->stream().go_on();
        static_cast<void>(feeder.more(ignored));
    }
    return static_cast<double>(ticks) / (ticks_per_us * 1e6);
}

} // namespace

LimitAdvice what_would_help(const HelpArguments& arguments, const Summary& summary) {
    const RunMachine& of = *arguments.machine;
    LimitAdvice out;
    out.moves = arguments.path->format->is_gcode() && summary.waypoints > most_moves ? most_moves : 0;
    const double moving_s = summary.cycle_time_s - arguments.standing_s;
    const double part_s = out.moves > 0 ? planned_s(arguments, of, 1.0, out.moves, arguments.planner) : moving_s;
    const auto add = [&](const std::string& name, const std::string& setting, std::uint64_t window, double planned) {
        const double seconds = moving_s * (planned / part_s) + arguments.standing_s; // the rest as the part
        out.limits.push_back({name, setting, window, seconds, 1.0 - seconds / summary.cycle_time_s});
    };
    for (const Candidate& candidate : candidates(of.machine, summary)) {
        MachineDescription machine = of.as_stated();
        if (candidate.of_machine != nullptr) {
            machine.settings.*candidate.of_machine *= raised;
        } else if (candidate.of_axis != nullptr) {
            machine.settings.axis[candidate.limit.axis].*candidate.of_axis *= raised;
        }
        if (!MotionLimits<double>::make(machine.settings).has_value()) {
            continue; // the limit is as high as a machine may state it
        }
        const std::string setting = setting_of(candidate, machine);
        const RunMachine higher(std::move(machine), arguments.path->format->is_gcode());
        const double factor = candidate.limit.kind == LimitKind::feed ? raised : 1.0;
        add(candidate.name, setting, 0, planned_s(arguments, higher, factor, out.moves, arguments.planner));
    }
    PlannerChoice longer = arguments.planner;
    longer.window_cells = std::min(longer.window_cells * times_longer, longest_window);
    if (summary.window_limited > 0 && longer.window_cells > arguments.planner.window_cells) {
        const double seconds = planned_s(arguments, of, 1.0, out.moves, longer);
        add(fmt::format("window of {} cells", longer.window_cells), {}, longer.window_cells, seconds);
    }
    std::ranges::stable_sort(out.limits, [](const auto& a, const auto& b) { return a.gain > b.gain; });
    return out;
}

} // namespace splinefeed::host
