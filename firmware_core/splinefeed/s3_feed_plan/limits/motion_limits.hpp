// SPDX-License-Identifier: MIT
// MotionLimits: what the machine can do: checked once, in the scalar of the pipeline.
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/base/status.hpp"
#include "splinefeed/base/units.hpp"
#include "splinefeed/number/scalar.hpp"
#include "splinefeed/s2_arc_length/arc_length.hpp"
#include "splinefeed/s3_feed_plan/limits/machine_numbers.hpp"
#include "splinefeed/s3_feed_plan/limits/machine_timing.hpp"

#include <cstdint>

namespace splinefeed {

/// One tick of a feed segment's duration is 1/8 us.

/// The numbers in which a motion with limited jerk is sampled: those of its JerkPlanner.
enum class SampledIn : std::uint8_t {
    scalar, ///< the scalar of the pipeline
    float64 ///< double, whatever the scalar: JerkPlanner<S, double>
};

/// The checked limits. A plain aggregate: for a microcontroller the compiler can build it.
template <Scalar S>
struct MotionLimits {
    int axes = 0;
    PerAxis<S> velocity_mm_s{};
    PerAxis<S> acceleration_mm_s2{};           ///< in the direction of the axis's velocity
    PerAxis<S> braking_mm_s2{};                ///< against the axis's velocity
    PerAxis<std::uint64_t> steps_per_mm_q32{}; ///< counts per mm, 32 fraction bits
    S feed_mm_s{};                             ///< the part of max_feed_mm_s that planning may use
    S turning_mm_s{};                          ///< the same of max_turning_deg_s; at least feed_mm_s
    S path_mm_s{}; ///< upper limit of the speed along the path, over all axes; without rotary axes feed_mm_s
    PerAxis<bool> rotary{};
    PerAxis<S> end_velocity_mm_s{};        ///< of an axis outside Refinement::open; 0: no such limit
    bool mixed = false;                    ///< some axes are rotary and some are not
    PerAxis<S> jerk_mm_s3{};               ///< meaningful where jerk_limited
    bool jerk_limited = false;             ///< some axis has a jerk limit that binds: the motion needs a JerkPlan
    SampledIn sampled = SampledIn::scalar; ///< a planner that samples more coarsely does not suit them
    S usable{}; ///< the part of a limit that planning may use, before the noise of positions is
                ///< subtracted
    S feed_noise_mm_s{};
    S centripetal_mm_s2{};           ///< 0: none
    S chord_mm_s2{};                 ///< 8 e / T^2, to be divided by the curvature; 0: none
    S segments_per_s{};              ///< feed segments per second
    std::uint32_t segment_ticks = 0; ///< duration of a feed segment
    int segments_per_sample = 1;     ///< feed segments per sample period
    Refinement<S> refinement{};

    /// The part of a programmed feed that planning may use; at least half of it.
    [[nodiscard]] constexpr S usable_feed(S feed) const noexcept {
        return larger(feed * usable - feed_noise_mm_s, scale2(feed, -1));
    }

    /// Checks every number (the error names the first one that is out of range) and computes the rest.
    /// @param sampled  with float64 cells may be longer, and rounding takes less of a jerk limit
    [[nodiscard]] static constexpr Result<MotionLimits, LimitError>
    make(const MachineSettings& stated, SampledIn sampled = SampledIn::scalar) noexcept;
};

namespace detail {

/// Relative resolution of the curve parameter within a cell, with the rounding that the polynomials add.
template <Scalar S>
inline constexpr double parameter_error = 9.4e-10; // 4 ulp of Q31.32; double takes the same cells, so that results are
                                                   // comparable
template <>
inline constexpr double parameter_error<float> = 2.4e-7;   // 4 x 2^-24
inline constexpr double parameter_error_in_double = 4e-15; // 18 ulp, of motions with limited jerk

/// The part of every limit that planning leaves for relative rounding.
template <Scalar S>
inline constexpr double usable_margin = 6e-6; // twice the feed fluctuation that arc length tolerates
template <>
inline constexpr double usable_margin<float> = 1e-3;

/// The part of an acceleration limit that rounding may use before cells are made shorter.
template <Scalar S>
inline constexpr double rounding_share = 2e-5;
template <>
inline constexpr double rounding_share<float> = 2e-3;

/// The same part of an axis's own limit, for jumps of its speed that rounding causes where cells meet. With a smaller
/// part float would be slow: its cells know a direction to about 2^-20.
template <Scalar S>
inline constexpr double jump_share = 4e-5;
template <>
inline constexpr double jump_share<float> = 1e-2;

/// A plan with a jerk limit has moves in closed form between stops alone; in Fixed rounding needs shorter cells.
constexpr WholeLines whole_lines(bool jerk_limited, bool in_double) noexcept {
    return !jerk_limited ? WholeLines::all : in_double ? WholeLines::between_stops : WholeLines::none;
}

/// Rounding of a position by e becomes the acceleration 4 e / T^2 in the second difference of control points.
constexpr double acceleration_noise(double error_mm, double segment_s) noexcept {
    return 4.0 * error_mm / (segment_s * segment_s);
}

/// The part of a jerk limit that the shape of a cell may be off by.
inline constexpr double shape_share = 0.15;

/// The error of the third derivative of a shape, times L^2, over AxisShape::error_bound (JerkWindow: ripple / 2).
inline constexpr double third_per_second = 5.2;

/// Rounding of a position by e becomes the jerk 8 e / T^3 in the third difference.
constexpr double jerk_noise(double error_mm, double segment_s) noexcept {
    return 8.0 * error_mm / (segment_s * segment_s * segment_s);
}

/// Rounding of a position by e becomes the speed 2 e / T in the first difference.
constexpr double speed_noise(double error_mm, double segment_s) noexcept {
    return 2.0 * error_mm / segment_s;
}

/// The longest way of an axis in a cell [mm]. The parameter has the relative resolution `error` in a cell. The rounding
/// that this causes must stay below `share` of the axis's acceleration and ten times `share` of the feed. It must stay
/// below a thousandth of the jerk if the jerk is limited (not 0), or three of them where cells would be very short.
/// @param most  it is not longer in any case
constexpr double longest_way_mm(double error, double share, double acceleration, double feed, double jerk,
                                double segment_s, double most) noexcept {
    const double by_acceleration = share * acceleration * segment_s * segment_s / (4.0 * error);
    const double by_feed = 10.0 * share * feed * segment_s / (2.0 * error);
    double length = by_acceleration < by_feed ? by_acceleration : by_feed;
    const double by_jerk = 1e-3 * jerk * segment_s * segment_s * segment_s / (8.0 * error);
    const double coarser = 3.0 * by_jerk < 0.25 ? 3.0 * by_jerk : 0.25; // so that a window shows enough of the path
    length = jerk > 0.0 && by_jerk < length ? (coarser > by_jerk ? coarser : by_jerk) : length;
    return length < 0.0625 ? 0.0625 : length > most ? most : length;
}

/// The longest way of an axis in a cell where rounding does not limit it: its acceleration times that fits in Fixed.
constexpr double longest_in_double(const AxisSettings& axis) noexcept {
    const double fits = 3.2e7 / axis.larger_acceleration_mm_s2();
    return fits < 1024.0 ? fits : 1024.0;
}

/// Change of direction at a joint that counts as rounding, not as a corner.
template <Scalar S>
inline constexpr double direction_noise = 2e-9;
template <>
inline constexpr double direction_noise<float> = 2e-6;

/// Largest curvature of a cell [1/mm]. Away from stops no plan is slower than v = 1e-3 mm/s. At that speed the
/// curvature k needs the acceleration k v^2, at most an eighth of the smallest limit. It needs the jerk q''' v^3, at
/// most a quarter of a limit. A hairpin that cells resolve has |q'''| up to some 5 k^2. @param jerk  0: not limited
constexpr double sharpest_curvature(double acceleration, double jerk) noexcept {
    constexpr double most = 16e6; // largest curvature that a cell can tell from infinite
    const double by_acceleration = 1e6 / 8.0 * acceleration;
    const double sharpest = by_acceleration < most ? by_acceleration : most;
    return jerk > 0.0 ? root_up_to(sharpest, 0.05e9 * jerk) : sharpest;
}

/// Limit from the chord error e at the sample period T: v^2 <= 8 e / (kappa T^2). Limited to the range of Fixed, where
/// it is no limit in practice.
constexpr double chord_limit(double error_mm, double period_s) noexcept {
    const double limit = 8.0 * error_mm / (period_s * period_s);
    return limit < 1e9 ? limit : 1e9;
}

/// The range of full speed. The emitted motion averages the plan over two segments to either side, which the axis
/// passes at its end velocity. The position deviates by T^2 A / 6. The zone begins earlier by that distance.
constexpr PositionRange open_travel(const AxisSettings& axis, double segment_s) noexcept {
    const double zone = axis.travel_end_zone_mm + 2.0 * segment_s * axis.travel_end_velocity_mm_s +
                        segment_s * segment_s * axis.larger_acceleration_mm_s2() / 6.0;
    const auto position = [](double mm) {
        return position_from_mm(mm < -1048576.0 ? -1048576.0 : mm > 1048576.0 ? 1048576.0 : mm);
    };
    return {position(axis.travel_low_mm + zone), position(axis.travel_high_mm - zone)};
}

/// Largest count of an axis, in either direction.
inline constexpr double most_counts = 2147483647.0;

/// The range of an axis's counter; 2^21 mm is beyond all waypoints and the overshoot of a curve.
constexpr PositionRange countable(const AxisSettings& axis) noexcept {
    const double mm = most_counts / axis.steps_per_mm;
    const Position reach = displaced(Position{}, mm < 2097152.0 ? mm : 2097152.0, 0);
    return {Position{-reach.raw}, reach};
}

/// The error of the first number that lies outside its range; LimitError::none if none does.
template <class Settings, std::size_t n>
constexpr LimitError range_error(const MachineNumber<Settings> (&numbers)[n], const Settings& settings) noexcept {
    for (const MachineNumber<Settings>& number : numbers) {
        if (!number.accepts(settings)) {
            return number.error;
        }
    }
    return LimitError::none;
}

/// What is wrong with the numbers that belong to no single axis.
constexpr LimitError machine_error(const MachineSettings& settings) noexcept {
    if (settings.axes < 1 || settings.axes > max_axes) {
        return LimitError::axes_out_of_range;
    }
    if (const LimitError error = range_error(path_numbers, settings); error != LimitError::none) {
        return error;
    }
    if (!sample_period.accepts(settings)) {
        return sample_period.error;
    }
    const int n = settings.segments_per_sample;
    const bool divides = n >= 0 && n <= 8 && (n == 0 || settings.sample_period_us * ticks_per_us % n == 0);
    return divides ? LimitError::none : LimitError::segments_per_sample_invalid;
}

/// What is wrong with the numbers of an axis.
template <Scalar S>
constexpr LimitError axis_error(const AxisSettings& axis) noexcept {
    if (const LimitError error = range_error(axis_numbers, axis); error != LimitError::none) {
        return error;
    }
    if (std::same_as<S, float> && axis.max_jerk_mm_s3 != 0.0) {
        return LimitError::jerk_in_float;
    }
    if (axis.travel_end_zone_mm == 0.0) {
        return LimitError::none;
    }
    if (axis.travel_end_velocity_mm_s == 0.0 || !position_representable(axis.travel_low_mm) ||
        !position_representable(axis.travel_high_mm) || !(axis.travel_low_mm < axis.travel_high_mm)) {
        return LimitError::travel_end_incomplete;
    }
    return axis.travel_low_mm * axis.steps_per_mm < -most_counts ||
                   axis.travel_high_mm * axis.steps_per_mm > most_counts
               ? LimitError::counts_out_of_range
               : LimitError::none;
}

} // namespace detail

template <Scalar S>
constexpr Result<MotionLimits<S>, LimitError> MotionLimits<S>::make(const MachineSettings& stated,
                                                                    SampledIn sampled) noexcept {
    if (const LimitError error = detail::machine_error(stated); error != LimitError::none) {
        return error;
    }
    MotionLimits limits;
    limits.axes = stated.axes;
    for (const unsigned k : indices(stated.axes)) {
        if (const LimitError error = detail::axis_error<S>(stated.axis[k]); error != LimitError::none) {
            return error;
        }
    }
    const MachineTiming timing(stated);
    const MachineSettings& settings = timing.settings;
    const double softest = timing.totals.softest;
    const double segment_s = timing.segment_s;
    const double smoothest = timing.smoothest;
    limits.mixed = timing.mixed;
    limits.jerk_limited = smoothest > 0.0;
    limits.sampled = limits.jerk_limited ? sampled : SampledIn::scalar;
    const bool in_double = limits.jerk_limited && (std::same_as<S, double> || sampled == SampledIn::float64);
    const double resolution = in_double ? detail::parameter_error_in_double : detail::parameter_error<S>;
    constexpr double usable = 1.0 - detail::usable_margin<S>;
    double feed_noise = 0.0;
    for (const unsigned k : indices(settings.axes)) {
        const AxisSettings& axis = settings.axis[k];
        // Planning leaves room for rounding: of the parameter, of positions (2^-41 mm) and of counts (2^-30). With a
        // jerk limit v^2 is a parabola of s, and the parameter is the sum of a series.
        const double parameter_error = (smoothest > 0.0 ? 4.0 : 1.0) * resolution;
        const double jerk = detail::planned_jerk(axis, segment_s);
        const double longest = detail::longest_way_mm(
            resolution, detail::rounding_share<S>, axis.smaller_acceleration_mm_s2(), settings.max_feed_mm_s,
            limits.jerk_limited ? jerk : 0.0, segment_s, in_double ? detail::longest_in_double(axis) : 16.0);
        limits.refinement.longest_mm[k] = from_double<S>(longest);
        const double error_mm = longest * parameter_error + 4.6e-13 + 9.4e-10 / axis.steps_per_mm;
        const double noise = detail::acceleration_noise(error_mm, segment_s);
        if (noise > 0.25 * axis.smaller_acceleration_mm_s2()) {
            return LimitError::period_too_short;
        }
        const double speed_noise = detail::speed_noise(error_mm, segment_s);
        if (speed_noise > 0.25 * axis.max_velocity_mm_s || speed_noise > 0.25 * settings.max_feed_mm_s) {
            return LimitError::period_too_short;
        }
        feed_noise += speed_noise;
        if (axis.travel_end_zone_mm != 0.0) {
            if (speed_noise > 0.25 * axis.travel_end_velocity_mm_s) {
                return LimitError::period_too_short;
            }
            limits.end_velocity_mm_s[k] = from_double<S>(axis.travel_end_velocity_mm_s * usable - speed_noise);
            limits.refinement.open[k] = detail::open_travel(axis, segment_s);
            const S piece = from_double<S>(axis.travel_end_zone_mm / 64.0);
            S& longest_piece = limits.refinement.end_piece_mm;
            longest_piece = longest_piece > S{} ? smaller(longest_piece, piece) : piece;
        }
        limits.velocity_mm_s[k] = from_double<S>(axis.max_velocity_mm_s * usable - speed_noise);
        // Tolerated jumps of the speed and of the direction at joints are accelerations, too.
        const auto planned = [&](double acceleration) {
            return from_double<S>(acceleration * usable - noise -
                                  detail::jump_share<S> * axis.smaller_acceleration_mm_s2() -
                                  detail::corner_share * softest);
        };
        limits.refinement.jump_mm_s[k] =
            from_double<S>(detail::jump_share<S> * axis.smaller_acceleration_mm_s2() * segment_s);
        limits.acceleration_mm_s2[k] = planned(axis.max_acceleration_mm_s2);
        limits.braking_mm_s2[k] = planned(axis.braking_mm_s2());
        limits.rotary[k] = axis.rotary;
        limits.refinement.countable[k] = detail::countable(axis);
        const double jerk_noise = detail::jerk_noise(error_mm, segment_s);
        if (limits.jerk_limited && jerk_noise > 0.25 * jerk) {
            return LimitError::period_too_short;
        }
        limits.jerk_mm_s3[k] = from_double<S>(jerk * (usable - detail::jerk_reserve) - jerk_noise);
        if (limits.jerk_limited) {
            limits.refinement.bend_mm_s2[k] = limits.acceleration_mm_s2[k];
            limits.refinement.error_mm_s3[k] = from_double<S>(detail::shape_share / detail::third_per_second * jerk);
        }
        limits.steps_per_mm_q32[k] = static_cast<std::uint64_t>(axis.steps_per_mm * 4294967296.0);
    }
    limits.usable = from_double<S>(usable);
    limits.feed_noise_mm_s = from_double<S>(feed_noise);
    limits.feed_mm_s = limits.usable_feed(from_double<S>(settings.max_feed_mm_s));
    limits.turning_mm_s = limits.usable_feed(from_double<S>(max_turning_deg_s(settings)));
    limits.path_mm_s = limits.mixed ? from_double<S>(timing.path_mm_s * usable) : limits.feed_mm_s;
    limits.centripetal_mm_s2 = from_double<S>(settings.centripetal_mm_s2 * usable);
    limits.chord_mm_s2 = from_double<S>(detail::chord_limit(settings.chord_error_mm, timing.period_s));
    limits.segments_per_s = from_double<S>(timing.segments / timing.period_s);
    limits.segment_ticks = static_cast<std::uint32_t>(settings.sample_period_us * ticks_per_us / timing.segments);
    limits.segments_per_sample = timing.segments;
    Refinement<S>& refinement = limits.refinement;
    refinement.axes = settings.axes;
    refinement.max_feed_mm_s = limits.feed_mm_s;
    // Cells next to a stop: 1/7.3 of the braking distance feed^2 / (2 A).
    refinement.grade_per_feed_sq = from_double<S>(1.0 / (7.3 * 2.0 * softest));
    refinement.sharpest = from_double<S>(detail::sharpest_curvature(softest, smoothest));
    refinement.whole_lines = detail::whole_lines(limits.jerk_limited, in_double);
    if (smoothest > 0.0) {
        refinement.finest_grade_log2 = 5;
        refinement.metric_error = scale2(refinement.metric_error, -3); // the jerk sees the third derivative of errors
        refinement.inverse_error = scale2(refinement.inverse_error, -3);
        refinement.curvature_change = scale2(refinement.curvature_change, -1); // a remainder that is proportional to
                                                                               // its cube
    }
    refinement.direction_jump = from_double<S>(timing.sharpest_kink()) + from_double<S>(detail::direction_noise<S>);
    return limits;
}

} // namespace splinefeed
