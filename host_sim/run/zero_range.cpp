// SPDX-License-Identifier: MIT
#include "host_sim/run/zero_range.hpp"

#include "host_sim/analysis/move_extent.hpp"
#include "host_sim/base/interruption.hpp"
#include "host_sim/base/short_number.hpp"
#include "host_sim/config/decimal_number.hpp"
#include "host_sim/planning/move_sources.hpp"

#include "splinefeed/s0_program/text/text_cursor.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr double apart_mm = 1.0;          // of the two zeros
constexpr double zero_rounding_mm = 1e-6; // what arcs and inches are rounded to

/// A program, move by move, with its zero at a place.
class MovedProgram {
public:
    MovedProgram(const PathArguments& arguments, const RunMachine& of, MachineState begins, double by)
        : input_(arguments, PathUse::executed, of.path()), axes_(of.machine.settings.axes) {
        const std::vector<Summary::AxisPlace> places = of.places(begins, true);
        begins.offsets.active = 0;
        begins.offsets.g92_applies = false;
        for (const unsigned k : indices(axes_)) {
            begins.offsets.systems[0].origin[k] = decimal_of(*places[k].zero_mm + by);
        }
        input_.begin_at(begins);
        program_ = move_source(input_, ScalarKind::float64, &problems_);
        static_cast<void>(program_->start(here_));
    }

    /// False: there are no more moves.
    bool next() {
        while (program_->next(step_)) {
            if (program_->awaits_answer()) {
                program_->answer(program_->expected_answer());
            }
            if (step_.kind == StepKind::move) {
                box_ = {};
                add_extent(step_.move.shape == MoveShape::line ? step_.move.to : here_, step_.move, axes_, box_);
                here_ = step_.move.to;
                return true;
            }
        }
        return false;
    }

    /// Of the move: that of a line is its end, since another move begins it.
    [[nodiscard]] const AxisBox& box() const noexcept { return box_; }
    [[nodiscard]] std::uint64_t line() const noexcept { return step_.line; }

private:
    PathInput input_;
    int axes_;
    ProblemList problems_{};
    std::unique_ptr<MoveSource> program_{};
    SourceStep step_{};
    PerAxis<Position> here_{};
    AxisBox box_{};
};

enum class Follows : std::uint8_t { zero, machine, neither };

Follows what_follows(const AxisBox& here, const AxisBox& there, unsigned axis) noexcept {
    const double low = there.low[axis] - here.low[axis];
    const double high = there.high[axis] - here.high[axis];
    const auto both = [&](double by) {
        return std::fabs(low - by) < zero_rounding_mm && std::fabs(high - by) < zero_rounding_mm;
    };
    return both(apart_mm) ? Follows::zero : both(0.0) ? Follows::machine : Follows::neither;
}

/// Inwards to 1 um, where that leaves a range.
Travel inward(const Travel& range) noexcept {
    constexpr double per_mm = 1000.0;
    const Travel out{std::ceil(range.low * per_mm - zero_rounding_mm) / per_mm,
                     std::floor(range.high * per_mm + zero_rounding_mm) / per_mm};
    return out.low <= out.high ? out : range;
}

/// Whole, where that is within.
double middle_of(const Travel& range) noexcept {
    const double middle = 0.5 * (range.low + range.high);
    const double whole = std::round(middle);
    return whole >= range.low && whole <= range.high ? whole : middle;
}

} // namespace

std::vector<ZeroRange> zero_ranges(const PathArguments& arguments, const RunMachine& of, const MachineState& begins) {
    MovedProgram here(arguments, of, begins, 0.0);
    MovedProgram there(arguments, of, begins, apart_mm);
    const int axes = of.machine.settings.axes;
    AxisBox box; // of what follows the zero
    PerAxis<bool> moved{};
    while (here.next()) {
        Interruption::point();
        if (!there.next() || here.line() != there.line()) {
            return {};
        }
        for (const unsigned k : indices(axes)) {
            const Follows follows = what_follows(here.box(), there.box(), k);
            const auto& travel = of.machine.travel[k];
            const bool is_outside = travel && (here.box().low[k] < travel->low || here.box().high[k] > travel->high);
            if (follows == Follows::neither || (follows == Follows::machine && is_outside)) {
                return {};
            }
            if (follows == Follows::zero) {
                box.low[k] = moved[k] ? std::min(box.low[k], here.box().low[k]) : here.box().low[k];
                box.high[k] = moved[k] ? std::max(box.high[k], here.box().high[k]) : here.box().high[k];
                moved[k] = true;
            }
        }
    }
    if (there.next()) {
        return {};
    }
    std::vector<ZeroRange> out;
    const std::vector<Summary::AxisPlace> places = of.places(begins, true);
    for (const unsigned k : indices(axes)) {
        ZeroRange& range = out.emplace_back();
        range.axis = upper_case(places[k].axis.front());
        range.now = *places[k].zero_mm;
        if (const auto& travel = of.machine.travel[k]; travel && moved[k]) {
            range.zero = inward({travel->low - box.low[k] + range.now, travel->high - box.high[k] + range.now});
            range.length = box.high[k] - box.low[k];
            range.travel = travel->high - travel->low;
        }
    }
    return out;
}

bool leaves(const std::vector<ZeroRange>& ranges) noexcept {
    return std::ranges::any_of(ranges, [](const ZeroRange& of) {
        return of.zero && (of.now < of.zero->low - zero_rounding_mm || of.now > of.zero->high + zero_rounding_mm);
    });
}

bool can_fit(const std::vector<ZeroRange>& ranges) noexcept {
    return !ranges.empty() &&
           std::ranges::all_of(ranges, [](const ZeroRange& of) { return !of.zero || of.zero->low <= of.zero->high; });
}

std::string zero_advice(const std::vector<ZeroRange>& ranges) {
    std::vector<std::string> within;
    std::vector<std::string> example;
    for (const ZeroRange& of : ranges) {
        if (of.zero && of.zero->low > of.zero->high) {
            return fmt::format("no zero helps: the program goes {} mm along {}, and the travel is {} mm",
                               short_number(of.length), of.axis, short_number(of.travel));
        }
        if (of.zero) {
            within.push_back(
                fmt::format("{} {}..{}", of.axis, short_number(of.zero->low), short_number(of.zero->high)));
        }
        example.push_back(short_number(of.zero ? middle_of(*of.zero) : of.now));
    }
    return within.empty() ? std::string()
                          : fmt::format("the program fits if the part's zero lies within {}: add --zero={}",
                                        fmt::join(within, ", "), fmt::join(example, ","));
}

} // namespace splinefeed::host
