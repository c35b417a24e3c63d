// SPDX-License-Identifier: MIT
//
// Random machines that are quick enough to be steered many times, and what is asked of them while they run.
#pragma once

#include "steered_run.hpp"

#include <optional>

namespace splinefeed_test {

/// Axes that are not so soft that a run takes minutes of its own time.
inline MachineSettings random_quick_machine(Random& random, int axes) {
    MachineSettings machine = random_machine(random, axes);
    for (AxisSettings& axis : machine.axis) {
        axis.max_acceleration_mm_s2 = random.decades(300.0, 3e4);
    }
    return machine;
}

/// Jerk limits over four decades of the time that the acceleration takes to rise.
inline void limit_jerk(Random& random, MachineSettings& machine) {
    for (AxisSettings& axis : machine.axis) {
        if (random.chance(0.9)) {
            axis.max_jerk_mm_s3 = std::min(axis.max_acceleration_mm_s2 / random.decades(1e-4, 1.0), 1e9);
        }
    }
}

/// A machine on a path, and how it runs where nothing disturbs it.
template <Scalar S>
struct QuickRun {
    MachineSettings machine;
    MotionLimits<S> limits;
    BezierPath path;
    std::size_t window;
    SteeredRun plain;
};

/// Nothing where the limits are refused, or where it would take minutes of the machine's time.
/// @param pieces  of the path
/// @param larger  cells of the window, every other time; else 16
/// @param change  is called with the machine
template <Scalar S, class Change>
std::optional<QuickRun<S>> random_quick_run(Random& random, int pieces, std::size_t larger, Change&& change) {
    const int axes = random.integer(1, max_axes);
    MachineSettings machine = random_quick_machine(random, axes);
    change(machine);
    const auto limits = limits_for<S, double>(machine);
    if (!limits.has_value()) {
        return std::nullopt;
    }
    const BezierPath path = random_path(random, axes, pieces, random.decades(0.3, 20.0), 0.1, 0.3);
    const std::size_t window = random.chance(0.5) ? 16 : larger;
    SteeredRun plain = run_steered<S>(path, machine, window, {});
    if (plain.endless || plain.segments.size() > 20'000) {
        return std::nullopt;
    }
    return QuickRun<S>{machine, *limits, path, window, std::move(plain)};
}

/// One to eight holds and overrides over a run of so many segments, some of them after its end.
inline std::vector<Event> random_events(Random& random, std::size_t segments) {
    const int count = random.integer(1, 8);
    std::vector<Event> events;
    std::size_t at = 0;
    for (int i = 0; i < count; ++i) {
        at += static_cast<std::size_t>(random.between(0.0, 2.0 * static_cast<double>(segments) / count));
        const int kind = random.integer(0, 3);
        const auto pause = static_cast<std::size_t>(random.decades(1.0, 300.0));
        if (kind == 0) {
            events.push_back({at, Order::hold});
            at += pause;
            events.push_back({at, Order::resume});
        } else if (kind == 1) {
            events.push_back({at, Order::override_feed, 0.0});
            at += pause;
            events.push_back({at, Order::override_feed, random.between(0.2, 2.0)});
        } else {
            events.push_back({at, Order::override_feed, random.between(0.1, 2.0)});
        }
    }
    return events;
}

/// The same, and of five one with an abort behind them.
inline std::vector<Event> random_events_and_abort(Random& random, std::size_t segments) {
    std::vector<Event> events = random_events(random, segments);
    if (random.chance(0.2)) {
        const auto later = static_cast<std::size_t>(random.decades(1.0, 300.0));
        events.push_back({events.back().segment + later, Order::abort});
    }
    return events;
}

/// One to six holds and overrides, 0 and 2 among them, close together or far apart; every other time ended by an abort
/// or by a hold.
inline std::vector<Event> random_orders(Random& random) {
    std::vector<Event> events;
    std::size_t at = 0;
    const int count = random.integer(1, 6);
    for (int i = 0; i < count; ++i) {
        at += static_cast<std::size_t>(random.decades(1.0, 600.0));
        const auto pause = static_cast<std::size_t>(random.decades(1.0, 400.0));
        switch (random.integer(0, 4)) {
        case 0: events.push_back({at, Order::override_feed, random.between(0.2, 2.0)}); break;
        case 1: events.push_back({at, Order::override_feed, 2.0}); break;
        case 2:
            events.push_back({at, Order::override_feed, 0.0});
            events.push_back({at += pause, Order::override_feed, random.between(0.3, 2.0)});
            break;
        default: events.push_back({at, Order::hold}); events.push_back({at += pause, Order::resume});
        }
    }
    if (random.chance(0.25)) {
        events.push_back({at + static_cast<std::size_t>(random.decades(1.0, 300.0)), Order::abort});
    } else if (random.chance(0.25)) {
        events.push_back({at + static_cast<std::size_t>(random.decades(1.0, 300.0)), Order::hold}); // for good
    }
    return events;
}

} // namespace splinefeed_test
