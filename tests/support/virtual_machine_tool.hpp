// SPDX-License-Identifier: MIT
//
// A controller with a machine in virtual time: three axes with limits, whose motion the simulated machine judges, with
// a spindle, a probe and home switches that a test sets.
#pragma once

#include "host_sim/machine/simulated_machine.hpp"
#include "host_sim/program/gcode/parameter_memory.hpp"

#include "splinefeed/acceleration_planner.hpp"
#include "splinefeed/controller/controller.hpp"
#include "splinefeed/controller/travel_guard.hpp"
#include "splinefeed/move_stream/scalar_stream.hpp"
#include "splinefeed/s0_program/cycles/spline_points.hpp"
#include "splinefeed/s0_program/expression.hpp"

#include <cmath>
#include <deque>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace splinefeed::test {

/// Travel 0 to 300, 0 to 200 and -80 to 0 mm; 100 mm/s, 1000 mm/s^2, 320 counts per mm; a spindle up to 10000 rpm.
inline ControllerSettings settings_of_machine_tool() {
    ControllerSettings out;
    out.machine.axes = 3;
    for (unsigned k = 0; k < 3; ++k) {
        out.machine.axis[k] = {100.0, 1000.0, 0.0, 320.0};
    }
    out.travel = {AxisTravel{true, {}, Decimal::from_integer(300)}, AxisTravel{true, {}, Decimal::from_integer(200)},
                  AxisTravel{true, Decimal::from_integer(-80), {}}};
    out.program.axes = 3;
    out.program.dialect = Dialect::grbl;
    out.name = "test";
    out.homes = 7;
    out.max_rpm = Decimal::from_integer(10000);
    return out;
}

/// Executes segments, a millisecond at a time.
class VirtualMachineTool final : public ControlledMachine {
public:
    explicit VirtualMachineTool(const ControllerSettings& settings) { adopt(settings); }
    /// Its numbers change; it stays where it is.
    void adopt(const ControllerSettings& settings) {
        description_.settings = settings.machine;
        for (unsigned k = 0; k < 3; ++k) {
            description_.axis_name[k] = std::string(1, "xyz"[k]);
            const double around = settings.travel[k].limited ? 1e-3 : 1e6;
            description_.travel[k] = host::Travel{to_mm(to_position(settings.travel[k].low)) - around,
                                                  to_mm(to_position(settings.travel[k].high)) + around};
        }
        judge_.emplace(description_, 1);
    }

    // What the test does to it.
    std::optional<double> plate; // z of the probe's contact [mm]
    std::uint32_t inputs = 0;
    Alarm alarm = Alarm::none;
    bool known = true;
    bool has_outputs = true;
    bool home_found = true;
    bool home_clears = true;
    std::int32_t input = 0;          // what input 1 answers, after spindle_ms
    std::uint32_t spindle_ms = 0;    // that it takes to its speed
    std::uint32_t halts_ms = 0;      // that it takes to halt by itself; 0: it does not
    std::vector<std::string> orders; // what it was told

    [[nodiscard]] bool has_room() const { return queue_.size() < 10; }
    /// Less than 5 ms of motion are left.
    [[nodiscard]] bool is_dry() const { return queue_.size() < 5; }
    void submit(const FeedSegment& segment) { queue_.push_back(segment); }
    void tick() {
        ++now_;
        feed_ = {};
        std::uint32_t left = 8000;
        while (!queue_.empty() && left >= queue_.front().duration_ticks) {
            left -= queue_.front().duration_ticks;
            execute(queue_.front());
            queue_.pop_front();
        }
        if (halt_at_ != 0 && now_ >= halt_at_ && halts_ms > 0) {
            stop_at(position_);
        }
        if (homing_ == HomingPhase::busy && now_ >= home_at_) {
            homing_ = home_found ? HomingPhase::done : home_clears ? HomingPhase::failed : HomingPhase::not_cleared;
            known = known || (home_found && home_axes_ == all_axes);
            PerAxis<Position> at = position_;
            for (unsigned k = 0; k < 3; ++k) {
                at[k] = (home_axes_ >> k & 1U) != 0 ? Position{} : at[k];
            }
            stop_at(at);
        }
    }
    [[nodiscard]] const PerAxis<Position>& position() const { return position_; }
    [[nodiscard]] bool moves() const { return moves_; }
    [[nodiscard]] double distance_mm() const { return distance_; }

    MachineReading read() noexcept override {
        MachineReading out;
        out.position = position_;
        out.stands = queue_.empty() && !moves_;
        out.executes = !queue_.empty();
        out.waypoint = out.executes ? queue_.front().waypoint : 0;
        out.known = known;
        out.spindle_ready = now_ >= spindle_at_;
        out.spindle_stands = now_ >= stands_at_;
        out.input = input;
        const bool contact = plate && to_mm(position_[2]) <= *plate;
        out.inputs = inputs | (contact ? InputBits::probe : 0U);
        out.touched = touched_.has_value();
        out.touched_at = touched_.value_or(PerAxis<Position>{});
        out.homing = homing_;
        out.alarm = alarm;
        out.feed_mm_min = feed_;
        return out;
    }
    void obey(const ProgramEvent& event) noexcept override {
        orders.push_back(std::to_string(static_cast<int>(event.kind)) + " " +
                         std::to_string(event.value.raw / Decimal::one));
        const bool stops = event.kind == EventKind::spindle_stop; // obeyed at once, and then it runs out
        spindle_at_ = stops ? now_ : now_ + spindle_ms;
        stands_at_ = stops && turned_ ? now_ + spindle_ms : stands_at_;
        turned_ = !stops && (turned_ || event.kind == EventKind::spindle_clockwise);
    }
    [[nodiscard]] bool has_output(EventKind kind, std::int32_t number) const noexcept override {
        return kind == EventKind::input_wait ? number == 1 : has_outputs;
    }
    void watch_probe(bool away) noexcept override {
        touched_.reset();
        away_ = away;
    }
    void home(std::uint32_t axes) noexcept override {
        home_axes_ = axes;
        homing_ = HomingPhase::busy;
        home_at_ = now_ + 200;
    }
    bool halt() noexcept override {
        halt_at_ = now_ + halts_ms;
        return halts_ms > 0;
    }
    void quick_stop() noexcept override {
        PerAxis<Position> at = position_;
        if (homing_ == HomingPhase::busy) { // half way
            homing_ = HomingPhase::failed;
            for (Position& axis : at) {
                axis.raw /= 2;
            }
        }
        stop_at(at);
    }
    void enable(bool on) noexcept override { orders.emplace_back(on ? "on" : "off"); }
    void reset_faults() noexcept override {
        orders.emplace_back("faults");
        alarm = alarm == Alarm::drive_fault ? Alarm::none : alarm;
    }

private:
    static constexpr std::uint32_t all_axes = 7;

    // From here on another chain of segments begins.
    void stop_at(const PerAxis<Position>& position) {
        queue_.clear();
        moves_ = false;
        halt_at_ = 0;
        position_ = position;
        judge_.emplace(description_, 1);
    }
    void execute(const FeedSegment& segment) {
        if (!judge_->submit(segment) || judge_->poll().phase == hal::PortPhase::fault) {
            throw std::runtime_error("the machine: " + judge_->failure().what);
        }
        const PerAxis<Position> before = position_;
        double way_sq = 0.0;
        for (unsigned k = 0; k < 3; ++k) {
            const double mm = static_cast<double>(segment.end[k]) / static_cast<double>(units_per_count) /
                              description_.settings.axis[k].steps_per_mm;
            position_[k] = position_from_mm(mm);
            way_sq += std::pow(mm - to_mm(before[k]), 2);
        }
        distance_ += std::sqrt(way_sq);
        moves_ = !segment.ends_at_rest();
        feed_ = Decimal{static_cast<std::int64_t>(std::sqrt(way_sq) * 60e3 * 1e9)};
        const bool contact = plate && to_mm(position_[2]) <= *plate;
        if (!touched_ && contact != away_) {
            touched_ = position_;
        }
    }

    host::MachineDescription description_;
    std::optional<host::SimulatedMachine> judge_;
    std::deque<FeedSegment> queue_;
    PerAxis<Position> position_{};
    std::optional<PerAxis<Position>> touched_;
    Decimal feed_{};
    HomingPhase homing_ = HomingPhase::none;
    std::uint32_t now_ = 0;
    std::uint32_t home_at_ = 0;
    std::uint32_t home_axes_ = 0;
    std::uint32_t halt_at_ = 0; // 0: it does not halt
    std::uint32_t spindle_at_ = 0;
    std::uint32_t stands_at_ = 0; // the spindle
    bool turned_ = false;         // it has
    double distance_ = 0.0;
    bool away_ = false;
    bool moves_ = false;
};

/// The controller of such a machine.
template <Scalar S>
class ControlledTool {
public:
    ControlledTool()
        : settings(settings_of_machine_tool()), machine(settings), limits_(*MotionLimits<S>::make(settings.machine)),
          window_(256), planner_(window_), guard_(settings.travel, 3),
          stream_(limits_, planner_, rules_cast<S>(path_rules(MachineSettings{})), &guard_),
          motion_(settings, stream_, &points_, &expression_) {
        controller = std::make_unique<Controller>(settings, motion_, machine, Controller::Memory{lines_, answers_});
    }

    void send(std::string_view bytes) { controller->receive(bytes, now_); }
    /// A millisecond.
    void tick() {
        FeedSegment segment;
        Pull pull = Pull::busy;
        while (machine.has_room() && (pull == Pull::item || pull == Pull::busy)) {
            pull = controller->next(segment, machine.is_dry(), now_);
            if (pull == Pull::item) {
                machine.submit(segment);
            }
        }
        machine.tick();
        ++now_;
        std::array<char, 512> part{};
        while (const std::size_t size = controller->take_answers(part)) {
            text.append(part.data(), size);
        }
    }

    ControllerSettings settings;
    VirtualMachineTool machine;
    std::unique_ptr<Controller> controller;
    std::string text; // what it has said

private:
    MotionLimits<S> limits_;
    std::vector<PlannedCell<S>> window_;
    AccelerationPlanner<S> planner_;
    TravelGuard<S> guard_;
    ScalarStream<S> stream_;
    SplinePoints<ProgramScalar> points_;
    host::ParameterMemory parameters_;
    Expression expression_{parameters_};
    LineMotion motion_;
    std::array<char, 4096> lines_{};
    std::array<char, 16384> answers_{};
    std::uint32_t now_ = 1000;
};

} // namespace splinefeed::test
