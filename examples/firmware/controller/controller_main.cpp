// SPDX-License-Identifier: MIT
// Reference firmware: a machine that senders operate, by the protocol of grbl. docs/how-to/port_to_a_board.md
//
//   sender ── UART ── ByteWire ── Controller, LineMotion ── StepperMachine ── ring of parts ── StepGenerator ── pins
//                     (tick)      └────────────── main loop ─────────────┘                       (tick)
#include "controller/byte_wire.hpp"
#include "controller/operator_settings.hpp"
#include "controller/stepper_machine.hpp"
#include "startup.hpp"

#include "splinefeed/acceleration_planner.hpp"
#include "splinefeed/base/slot.hpp"
#include "splinefeed/controller/controller.hpp"
#include "splinefeed/controller/travel_guard.hpp"
#include "splinefeed/move_stream/scalar_stream.hpp"
#include "splinefeed/s0_program/cycles/spline_points.hpp"
#include "splinefeed/s0_program/expression.hpp"
#include "splinefeed/s0_program/text/numbered_parameters.hpp"

namespace firmware {

namespace {

using splinefeed::Controller;
using splinefeed::Pull;

// Built in main: their bytes start as zeros, and no constructor runs before main.
splinefeed::Slot<std::array<MotionPart, board::parts + 1>> parts;
splinefeed::Slot<Steps> steps;
splinefeed::Slot<ByteWire> wire;
splinefeed::Slot<StepperMachine> stepper;
splinefeed::Slot<std::array<splinefeed::PlannedCell<Real>, board::window>> window;
splinefeed::Slot<splinefeed::AccelerationPlanner<Real>> planner;
splinefeed::Slot<splinefeed::TravelGuard<Real>> guard;
splinefeed::Slot<splinefeed::ScalarStream<Real>> stream;
splinefeed::Slot<splinefeed::LineMotion> motion;
splinefeed::Slot<Controller> controller;
std::array<char, operator_settings.receive_bytes> lines_memory;
std::array<char, Controller::least_answers> answers_memory;

/// The memory of curves through points, on a board that has some for it.
template <bool has_it>
splinefeed::PointCurve<splinefeed::ProgramScalar>* curve_memory() noexcept {
    if constexpr (has_it) {
        static splinefeed::Slot<splinefeed::SplinePoints<splinefeed::ProgramScalar>> points;
        return &points.build();
    } else {
        return nullptr;
    }
}

/// What evaluates expressions, on a board that has some memory for parameters.
template <std::size_t count>
splinefeed::WordEvaluator* word_evaluator() noexcept {
    if constexpr (count > 0) {
        static splinefeed::Slot<std::array<splinefeed::Decimal, count>> values;
        static splinefeed::Slot<splinefeed::NumberedParameters> parameters;
        static splinefeed::Slot<splinefeed::Expression> expression;
        return &expression.build(parameters.build(values.build()));
    } else {
        return nullptr;
    }
}

std::atomic<bool> estop; // as the last tick read it
std::atomic<bool> limit;

/// Milliseconds since the start.
class Clock {
public:
    std::uint32_t look() noexcept {
        const std::uint32_t ticks = steps->ticks();
        feeder_.look(ticks);
        for (; ticks - counted_ >= ticks_per_ms; counted_ += ticks_per_ms) {
            ++now_ms_;
        }
        return now_ms_;
    }

private:
    static constexpr std::uint32_t ticks_per_ms = 1000 / board::tick_us;
    static_assert(1000 % board::tick_us == 0);
    WatchdogFeeder feeder_;
    std::uint32_t counted_ = 0;
    std::uint32_t now_ms_ = 0;
};

/// Moves bytes between line and controller; returns whether there were some.
bool exchange(std::uint32_t now_ms) noexcept {
    std::array<char, 32> bytes{};
    bool some = false;
    while (const std::size_t count = wire->take(bytes)) {
        controller->receive({bytes.data(), count}, now_ms);
        some = true;
    }
    const std::size_t room = wire->room_to_send();
    const std::size_t count =
        controller->take_answers(std::span(bytes).first(room < bytes.size() ? room : bytes.size()));
    wire->send(std::span(bytes).first(count));
    return some || count > 0;
}

/// A round of the main loop; returns whether another one has something to do at once.
bool work(std::uint32_t now_ms) noexcept {
    // A sender that has gone holds its program, and the next one is greeted.
    static std::uint32_t session = 0;
    if (const std::uint32_t here = board::line_session(); here != session) {
        session = here;
        controller->disconnect();
        controller->connect();
    }
    // In this order: what a reset has stopped is not seen before the reset itself.
    stepper->look({estop.load(std::memory_order_relaxed), limit.load(std::memory_order_relaxed)}, wire->bytes_lost());
    const bool talks = exchange(now_ms);
    if (!stepper->has_room()) {
        controller->execute(now_ms);
        return talks;
    }
    splinefeed::FeedSegment segment;
    const Pull pull = controller->next(segment, stepper->is_dry(), now_ms);
    if (pull == Pull::item) {
        stepper->submit(segment);
    }
    return talks || pull == Pull::item || pull == Pull::busy;
}

} // namespace

void on_tick() {
    const Inputs inputs = begin_tick();
    estop.store(inputs.estop, std::memory_order_relaxed);
    limit.store(inputs.limit, std::memory_order_relaxed);
    board::run_ticks([&inputs](auto&& write) { steps->tick(inputs, write); });
    for (unsigned i = 0; i < board::ticks_an_interrupt; ++i) {
        // Not the functions themselves: those would be called by their addresses.
        if (wire->poll([] { return board::read_byte(); }, [](std::uint8_t byte) { return board::write_byte(byte); }) &&
            !steps->stands()) {
            steps->order(Stop::halted); // the controller will ask for the same
        }
    }
}

} // namespace firmware

int main() {
    using namespace firmware;
    board::start();
    Steps& generator = steps.build(parts.build(), lookahead, board::lines());
    wire.build();
    const bool by_watchdog = board::watchdog_bit(); // in motion, as a rule
    stepper.build(generator, !by_watchdog);
    stream.build(*operated_limits, planner.build(window.build()), path_rules,
                 &guard.build(operator_settings.travel, static_cast<int>(axes)));
    motion.build(operator_settings, *stream, curve_memory<board::curves_through_points>(),
                 word_evaluator<board::parameters>());
    controller.build(operator_settings, *motion, *stepper, Controller::Memory{lines_memory, answers_memory});
    board::start_timer();
    board::start_watchdog();
    wire->send(by_watchdog
                   ? std::string_view("[MSG:The watchdog has reset the board: where the axes stand is lost]\r\n")
                   : std::string_view("[MSG:The board has started: where the axes stand counts as 0]\r\n"));
    controller->connect();
    Clock clock;
    for (;;) {
        const std::uint32_t now_ms = clock.look();
        bool idle = !work(now_ms);
        while (idle) { // until the next millisecond, or the next byte
            idle = clock.look() == now_ms && !wire->has_come();
        }
    }
}
