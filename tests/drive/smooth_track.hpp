// SPDX-License-Identifier: MIT
// A circle of two axes, from rest to rest, as feed segments of a millisecond; and where it is, in double.
#pragma once

#include "splinefeed/hal/modbus/setpoint/trajectory_buffer.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace splinefeed::test {

class Circle {
public:
    static constexpr double radius_counts = 6400.0;   ///< 20 mm at 320 counts/mm
    static constexpr double speed_counts_s = 32000.0; ///< 100 mm/s, at most

    /// Once round: it speeds up and slows down in a third of the way each.
    [[nodiscard]] std::array<double, 2> at(double time_s) const {
        const double share = std::fmin(std::fmax(time_s / duration_s(), 0.0), 1.0);
        // The integral of a speed that rises as sin^2, is constant, and falls so.
        const double angle = 2.0 * std::numbers::pi * way(share);
        return {start_ + radius_counts * std::sin(angle), radius_counts * (1.0 - std::cos(angle))};
    }
    [[nodiscard]] double duration_s() const {
        return 2.0 * std::numbers::pi * radius_counts / (speed_counts_s * (1.0 - ramp));
    }
    /// Of both axes together, at most. [counts/s^2]
    [[nodiscard]] double acceleration() const {
        const double along = speed_counts_s * std::numbers::pi / (2.0 * ramp * duration_s());
        return std::hypot(along, speed_counts_s * speed_counts_s / radius_counts);
    }

    [[nodiscard]] hal::modbus::TrajectoryBuffer track() const {
        const int count = static_cast<int>(std::ceil(duration_s() * 1000.0));
        hal::modbus::TrajectoryBuffer out(static_cast<std::size_t>(count));
        FeedSegment segment;
        segment.duration_ticks = 8000;
        for (int i = 0; i < count; ++i) {
            for (std::size_t k = 0; k < 2; ++k) {
                segment.start[k] = units(at(i * 1e-3)[k]);
                segment.end[k] = units(at((i + 1) * 1e-3)[k]);
                segment.start_velocity[k] = rate(i * 1e-3, k);
                segment.end_velocity[k] = i + 1 == count ? 0 : rate((i + 1) * 1e-3, k);
            }
            out.push(segment);
        }
        return out;
    }

    explicit Circle(double start_counts = 0.0) : start_(start_counts) {}

private:
    static constexpr double ramp = 0.25; // share of the time that it speeds up, and slows down

    static double way(double share) {
        const auto rise = [](double x) { // integral of sin^2(pi x / 2 ramp)
            return 0.5 * x - 0.5 * ramp / std::numbers::pi * std::sin(std::numbers::pi * x / ramp);
        };
        const double whole = 1.0 - ramp;
        if (share < ramp) {
            return rise(share) / whole;
        }
        return share > 1.0 - ramp ? 1.0 - rise(1.0 - share) / whole : (0.5 * ramp + share - ramp) / whole;
    }
    static std::int64_t units(double counts) { return std::llround(counts * static_cast<double>(units_per_count)); }
    [[nodiscard]] std::int64_t rate(double time_s, std::size_t axis) const { // units per millisecond
        constexpr double h = 1e-5;
        return units((at(time_s + h)[axis] - at(time_s - h)[axis]) / (2.0 * h) * 1e-3);
    }

    double start_;
};

} // namespace splinefeed::test
