// SPDX-License-Identifier: MIT
//
// Motions for the simulated machine, made as the stream makes them: samples of a position become control points of a
// uniform B-spline.
#pragma once

#include "host_sim/machine/simulated_machine.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace splinefeed::host {

using hal::PortPhase;

inline constexpr std::uint32_t millisecond = 8000; // ticks
inline constexpr double period_s = 1e-3;

using Motion = std::vector<FeedSegment>;

inline MachineDescription machine_of(std::vector<std::string> names) {
    MachineDescription machine;
    machine.settings.axes = static_cast<int>(names.size());
    machine.settings.max_feed_mm_s = 1000.0;
    for (unsigned k = 0; k < names.size(); ++k) {
        machine.axis_name[k] = names[k];
        machine.settings.axis[k] = {100.0, 1000.0, 0.0, 1000.0};
    }
    return machine;
}

inline std::int64_t units(double mm) {
    return std::llround(mm * 1000.0 * static_cast<double>(units_per_count));
}

// Samples [mm] of one axis of `axes`; the others stand still.
inline Motion motion_of(const std::vector<long double>& samples, unsigned axis = 0,
                        std::uint32_t duration = millisecond) {
    const long double sixths = 1000.0L * static_cast<long double>(units_per_count) / 6.0L;
    std::vector<std::int64_t> c(3, std::llround(samples.front() * sixths));
    for (const long double sample : samples) {
        c.push_back(std::llround(sample * sixths));
    }
    c.insert(c.end(), 3, c.back());
    Motion motion;
    for (std::size_t i = 1; i + 2 < c.size(); ++i) {
        FeedSegment segment;
        segment.index = motion.size();
        segment.waypoint = static_cast<std::uint32_t>(motion.size() / 10);
        segment.duration_ticks = duration;
        segment.start[axis] = c[i - 1] + 4 * c[i] + c[i + 1];
        segment.end[axis] = c[i] + 4 * c[i + 1] + c[i + 2];
        segment.start_velocity[axis] = 3 * (c[i + 1] - c[i - 1]);
        segment.end_velocity[axis] = 3 * (c[i + 2] - c[i]);
        motion.push_back(segment);
    }
    return motion;
}

inline void repeat(std::vector<long double>& list, int n, long double value) {
    list.insert(list.end(), static_cast<std::size_t>(n), value);
}

// Positions from rest with these second differences [mm/s^2].
inline std::vector<long double> integrated(const std::vector<long double>& accelerations) {
    std::vector<long double> q{0.0L, 0.0L, 0.0L};
    for (const long double a : accelerations) {
        q.push_back(2.0L * q.back() - q[q.size() - 2] + a * 1e-6L);
    }
    return q;
}

// From rest to `velocity`, and to rest again, at this acceleration at most.
inline Motion there(double velocity, double acceleration, unsigned axis = 0) {
    const int n = static_cast<int>(std::ceil(velocity / (acceleration * period_s)));
    const long double a = static_cast<long double>(velocity) / (n * 1e-3L);
    std::vector<long double> list;
    repeat(list, n, a);
    repeat(list, 10, 0.0L);
    repeat(list, n, -a);
    repeat(list, 3, 0.0L);
    return motion_of(integrated(list), axis);
}

// The first motion, and that of axis 1 of the second one, which takes as long.
inline Motion both(Motion first, const Motion& second) {
    for (std::size_t i = 0; i < first.size(); ++i) {
        first[i].start[1] = second.at(i).start[1];
        first[i].end[1] = second[i].end[1];
        first[i].start_velocity[1] = second[i].start_velocity[1];
        first[i].end_velocity[1] = second[i].end_velocity[1];
    }
    return first;
}

// A raw segment of axis 0 from rest at 0 to `end_mm`, `duration` long.
inline FeedSegment stroke(double end_mm, std::uint32_t duration, std::int64_t end_velocity = 0) {
    FeedSegment segment;
    segment.duration_ticks = duration;
    segment.end[0] = units(end_mm);
    segment.end_velocity[0] = end_velocity;
    return segment;
}

inline PortPhase run(SimulatedMachine& machine, const Motion& motion) {
    for (const FeedSegment& segment : motion) {
        while (machine.room() == 0) {
            machine.poll();
        }
        if (!machine.submit(segment)) {
            return machine.poll().phase;
        }
    }
    PortPhase phase = PortPhase::running;
    while (phase == PortPhase::running) {
        phase = machine.poll().phase;
    }
    return phase;
}

inline std::string fault_of(const MachineDescription& description, const Motion& motion,
                            const SimulationOptions& options = {}) {
    SimulatedMachine machine(description, 1, options);
    run(machine, motion);
    return machine.fault() ? fault_name(machine.fault()->kind) : "none";
}

struct Row {
    double t;
    double x;
    double speed;
};

struct Recorder final : TraceSink {
    std::vector<Row> rows;
    std::size_t breaks_at = 1000000;
    void row(std::uint64_t ticks, const PerAxis<double>& position_mm, double speed_mm_s) override {
        if (rows.size() == breaks_at) {
            throw std::runtime_error("disk full");
        }
        rows.push_back({static_cast<double>(ticks) / 8e6, position_mm[0], speed_mm_s});
    }
};

inline constexpr double over = 1.0 + 1e-5;
inline constexpr double hardly_over = 1.0 + 1e-9;

} // namespace splinefeed::host
