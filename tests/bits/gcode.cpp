// SPDX-License-Identifier: MIT
// A program in G-code with each kind of block: every item that the interpreter makes of it, and the motion within its
// tolerances.
#include "corpus.hpp"
#include "machines.hpp"
#include "splinefeed/acceleration_planner.hpp"
#include "splinefeed/s0_program/expression.hpp"
#include "splinefeed/s0_program/interpreter.hpp"
#include "splinefeed/s1_blended_path/tolerance_path.hpp"
#include "splinefeed/trajectory.hpp"

using namespace splinefeed;

namespace bits {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view lines[] = {
    "G21 G90 G17 G64 P0.01 F3000 (a program with each kind of block)"sv,
    "G0 X10.5 Y-3.25 Z5"sv,
    "G1 X12.345 Y6.789 Z0.125"sv,
    "X13.001 Y7.002"sv,
    "X13.503 Y7.125 Z-0.031"sv,
    "X14.001 Y7.202"sv,
    "X14.499 Y7.235 Z-0.05"sv,
    "X15 Y7.2"sv,
    "G2 X20 Y7.125 R9.25"sv,
    "G3 X30 Y10 R20"sv,
    "G3 I-5 Z-1 P2"sv,
    "G18 G2 X35 Z4 R6"sv,
    "G17 G20 G91 G1 X0.1 Y-0.2"sv,
    "G21 G90 G10 L2 P2 X1 Y2 R30"sv,
    "G55 G1 X1 Y1"sv,
    "G2 X3 Y3 I1 J1"sv,
    "#1 = [SIN[30] * 4 + SQRT[2] ** 3] #2 = [ATAN[1]/[3] / 7]"sv,
    "G1 X[#1 + EXP[0.5]] Y#2"sv,
    "G54 G99 G81 X10 Y10 Z-4 R1 L2"sv,
    "G83 X20 Z-3 R1 Q0.75"sv,
    "G80"sv,
    "G5 X40 Y0 I3 J4 P-5 Q6"sv,
    "G5.2 X50 Y10 P2 L4"sv,
    "X60 Y0 P1"sv,
    "X70 Y10 P0.5"sv,
    "X80 Y0 P1"sv,
    "G5.3"sv,
    "G61 G1 X78 Y3"sv,
    "X75"sv,
    "G64 P0.05 G93 G1 X71 Y2 F30"sv,
    "G94 M3 S1000 M8 F500"sv,
    "M62 P3 G1 X75"sv,
    "G4 P0.25"sv,
    "X70 Y9"sv,
    "G28 Z1"sv,
    "M30"sv,
};

/// #1 to #9; there are no names.
class Numbered final : public ParameterTable {
public:
    bool read(std::int32_t number, Decimal& out) const noexcept override {
        out = known(number) ? values_[static_cast<unsigned>(number)] : Decimal{};
        return known(number);
    }
    bool write(std::int32_t number, Decimal value) noexcept override {
        if (known(number)) {
            values_[static_cast<unsigned>(number)] = value;
        }
        return known(number);
    }
    bool read(std::string_view, Decimal&) const noexcept override { return false; }
    bool write(std::string_view, Decimal) noexcept override { return false; }
    void forget(std::int32_t number) noexcept override { static_cast<void>(write(number, {})); }
    void forget(std::string_view) noexcept override {}

private:
    static bool known(std::int32_t number) { return number > 0 && number < 10; }

    std::array<Decimal, 10> values_{};
};

template <Scalar S>
void add_item(Hash& hash, const ProgramItem<S>& item) {
    hash.add(static_cast<std::uint64_t>(item.kind));
    hash.add(item.line);
    if (item.kind == ItemKind::dwell) {
        hash.add(static_cast<std::uint64_t>(item.dwell_s.raw));
    } else if (item.kind == ItemKind::event) {
        hash.add(static_cast<std::uint64_t>(item.event.kind));
        hash.add(static_cast<std::uint64_t>(item.event.value.raw));
    } else {
        const PathElement<S>& element = item.element;
        hash.add(static_cast<std::uint64_t>(element.shape));
        hash.add_scalar(element.feed_mm_s);
        for (unsigned k = 0; k < axes; ++k) {
            hash.add(element.to[k]);
            for (unsigned i = 0; element.shape == MoveShape::bezier && i < 6; ++i) {
                hash.add_scalar(element.bezier.points[k][i]);
            }
            if (element.shape == MoveShape::arc) {
                hash.add(element.arc.centre[k]);
                hash.add_scalar(element.arc.normal[k]);
            }
        }
    }
}

/// A program's moves into a path, and its segments as hashes. A move waits until it is known whether the machine stops
/// at its end.
template <Scalar S>
class Run {
public:
    bool travel() {
        bool good = path_.start({}).ok();
        auto trajectory = Trajectory<S>::make(path_, *uneven_limits<S>, planner_);
        good = good && trajectory.has_value();
        FeedSegment segment;
        for (Pull pull = Pull::starved; good && pull != Pull::finished; pull = trajectory->next(segment)) {
            if (pull == Pull::item) {
                motion.add(segment);
            } else if (path_.has_room()) {
                good = push_move();
            }
        }
        return good && trajectory->status().ok();
    }

    Hash items;
    Hash motion;

private:
    /// The next move of the program, or its end.
    bool push_move() {
        for (;;) {
            const Pull pull = interpreter_.next(item_);
            if (pull == Pull::finished) {
                const bool good = !waits_ || path_.push(waiting_).ok();
                waits_ = false;
                return good && path_.finish().ok();
            }
            if (pull == Pull::starved) {
                if (!interpreter_.push(lines[line_], static_cast<std::uint32_t>(line_) + 1).ok()) {
                    return false;
                }
                ++line_;
                continue;
            }
            add_item<S>(items, item_);
            waiting_.stop_at_end = waiting_.stop_at_end || item_.stops_before;
            if (item_.kind == ItemKind::move) {
                const bool good = !waits_ || path_.push(waiting_).ok();
                waiting_ = item_.element;
                waits_ = true;
                return good;
            }
        }
    }

    Numbered parameters_;
    Expression expression_{parameters_};
    Interpreter<S> interpreter_{ProgramSettings{}, &expression_};
    ProgramItem<S> item_{};
    PathElement<S> waiting_{};
    bool waits_ = false;
    std::size_t line_ = 0;
    TolerancePath<S> path_{axes, {literal<S>(0.001)}};
    std::array<PlannedCell<S>, 32> window_{};
    AccelerationPlanner<S> planner_{window_};
};

} // namespace

template <Scalar S>
void run_programs() {
    Run<S> run;
    const bool good = run.travel();
    report<S>("gcode, its items", run.items, good);
    report<S>("gcode, its motion", run.motion, good);
}

template void run_programs<Fixed>();
template void run_programs<float>();
template void run_programs<double>();

} // namespace bits
