// SPDX-License-Identifier: MIT
// WaypointCurve: what all streaming curve methods share: the ring of recent waypoints ("knots") with their chords,
// merging of coincident points, and the decision where the curve is broken into smooth runs.
#pragma once

#include "splinefeed/s1_curve/curve_source.hpp"
#include "splinefeed/splines/parameterization.hpp"

#include <cstdint>

namespace splinefeed {

/// What the shared part of the streaming methods needs to know.
template <Scalar S>
struct CurveOptions {
    int axes = 3;
    Parameterization parameterization = Parameterization::chordal;
    S corner_cosine = literal<S>(0.5); ///< cos(corner angle): a sharper turn breaks the curve; default 60 degrees
    /// Longest move that push takes, at most 65536. Motion along a longer one would feel float's 24 bits in the
    /// acceleration (docs/explanation/numbers.md); who wants the geometry alone may raise it.
    std::int32_t longest_move_mm = std::same_as<S, float> ? 512 : 65536;
    /// Whether the last segment of the lead-in and the first of the lead-out are delivered, too: what Seam::repeated
    /// takes.
    bool seam_segments = false;
};

/// cos of a corner angle in degrees, 0 to 180, for CurveOptions; host and compile-time use.
[[nodiscard]] constexpr double corner_cosine(double degrees) noexcept {
    // Taylor's series about 90 degrees, where the argument stays below pi/2: 12 terms leave 1e-16.
    const double x = (90.0 - degrees) * 3.14159265358979323846 / 180.0;
    double term = x;
    double sum = x;
    for (int n = 1; n <= 12; ++n) {
        term *= -x * x / ((2.0 * n) * (2.0 * n + 1.0));
        sum += term;
    }
    return sum;
}

/// A waypoint in the ring. `chord`, `length`, `span` lead to the next knot, in chord units (2^-12 mm).
template <Scalar S>
struct Knot {
    PerAxis<Position> position{};
    PerAxis<S> chord{};
    S length{};
    S span{}; ///< interval of the curve parameter
    S feed_mm_s{};
    S max_feed_mm_s{};
    Corner corner = Corner::automatic;
    Role role = Role::path;
    bool breaks = false; ///< a smooth run ends here and the next begins
    std::uint32_t waypoint = 0;
};

/// Base of the streaming methods. Push until it is full, make room with next().
/// Memory: the ring. Cost of push: constant.
template <Scalar S>
class WaypointCurve : public CurveSource<S> {
public:
    /// Whether push would be taken. next() makes room.
    [[nodiscard]] bool has_room() const noexcept { return known_ - oldest_ < capacity; }

    /// Takes the next waypoint. One within 0.1 um of its predecessor on every axis is merged into it. What is refused
    /// changes nothing. Errors: no_room (push it again once next() has made room; while a motion is held it makes
    /// none), input_finished, position_out_of_range, move_too_long.
    Status push(const Waypoint<S>& waypoint, Role role = Role::path) noexcept;

    /// No more waypoints will come. Refused when there was no move at all.
    Status finish() noexcept;

protected:
    static constexpr std::uint64_t capacity = 32; ///< knots in the ring: 16 of look-ahead, the run's tail, and slack

    explicit WaypointCurve(const CurveOptions<S>& options) noexcept : options_(options) {}
    ~WaypointCurve() = default;

    [[nodiscard]] Knot<S>& knot(std::uint64_t i) noexcept { return ring_[i % capacity]; }
    [[nodiscard]] const Knot<S>& knot(std::uint64_t i) const noexcept { return ring_[i % capacity]; }
    /// Whether `breaks` of knot i is final.
    [[nodiscard]] bool decided(std::uint64_t i) const noexcept { return i + 1 < known_ || (finished_ && i < known_); }
    /// Whether it is known where the segment i -> i+1 ends, and how; `item`: it is.
    [[nodiscard]] Pull ready(std::uint64_t i) const noexcept {
        if (i + 1 >= known_) {
            return finished_ ? Pull::finished : Pull::starved;
        }
        return decided(i + 1) ? Pull::item : Pull::starved;
    }
    /// Whether segment i -> i+1 is delivered: not lead-in, not lead-out, but for the seam's own two.
    [[nodiscard]] bool travelled(std::uint64_t i) const noexcept {
        const bool enters = knot(i).role != Role::lead_in || (options_.seam_segments && knot(i + 1).role == Role::path);
        const bool leaves =
            knot(i + 1).role != Role::lead_out || (options_.seam_segments && knot(i).role == Role::path);
        return enters && leaves;
    }
    /// Fills all of a segment i -> i+1 but the control points.
    void describe_segment(std::uint64_t i, int degree, CurveSegment<S>& out) const noexcept;
    /// One-sided parameter spans at the ends of a run are 0 (a clamped end).
    [[nodiscard]] int axes() const noexcept { return options_.axes; }

    CurveOptions<S> options_;
    std::array<Knot<S>, capacity> ring_{};
    std::uint64_t known_ = 0;  ///< knots pushed so far
    std::uint64_t oldest_ = 0; ///< first knot that is still needed
    std::uint32_t pushed_ = 0; ///< index of the next waypoint, modulo 2^32
    bool finished_ = false;

private:
    friend struct CounterSeam;

    void decide_corner(std::uint64_t i) noexcept;
    [[nodiscard]] S span_of(S length) const noexcept;
};

} // namespace splinefeed
