// SPDX-License-Identifier: MIT
// WaypointCurve: the base of all streaming curve methods. It holds the ring of recent waypoints ("knots") with their
// chords, merges coincident points, and decides where corners break the curve into smooth runs.
#pragma once

#include "splinefeed/s1_curve/curve_source.hpp"
#include "splinefeed/splines/parameterization.hpp"

#include <cstdint>

namespace splinefeed {

/// The options that all streaming methods share.
template <Scalar S>
struct CurveOptions {
    int axes = 3;
    Parameterization parameterization = Parameterization::chordal;
    S corner_cosine = literal<S>(0.5); ///< cos(corner angle): a sharper turn breaks the curve; default 60 degrees
    /// Longest move that push accepts, at most 65536. On a longer one the 24 bits of float would show in the
    /// acceleration (docs/explanation/numbers.md). A program that needs only the geometry may raise it.
    std::int32_t longest_move_mm = std::same_as<S, float> ? 512 : 65536;
    /// Whether the last segment of the lead-in and the first of the lead-out are delivered as well: Seam::repeated
    /// needs them.
    bool seam_segments = false;
};

/// cos of a corner angle in degrees, 0 to 180, for CurveOptions. For the host and for compile time.
[[nodiscard]] constexpr double corner_cosine(double degrees) noexcept {
    // Taylor series about 90 degrees, where the argument stays below pi/2: after 12 terms the error is 1e-16.
    const double x = (90.0 - degrees) * 3.14159265358979323846 / 180.0;
    double term = x;
    double sum = x;
    for (int n = 1; n <= 12; ++n) {
        term *= -x * x / ((2.0 * n) * (2.0 * n + 1.0));
        sum += term;
    }
    return sum;
}

/// A waypoint in the ring. `chord`, `length` and `span` lead to the next knot, in chord units (2^-12 mm).
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
    bool breaks = false; ///< a smooth run ends here and the next one begins
    std::uint32_t waypoint = 0;
};

/// Base of the streaming methods. Push waypoints until it is full; next() makes room. Memory: the ring. Cost of push:
/// constant.
template <Scalar S>
class WaypointCurve : public CurveSource<S> {
public:
    /// Whether push() would accept a waypoint. next() makes room.
    [[nodiscard]] bool has_room() const noexcept { return known_ - oldest_ < capacity; }

    /// Accepts the next waypoint. A waypoint within 0.1 um of its predecessor on every axis is merged into it. After an
    /// error nothing has changed. Errors: no_room (push it again after next() has made room; while a motion is held,
    /// next() makes none), input_finished, position_out_of_range, move_too_long.
    Status push(const Waypoint<S>& waypoint, Role role = Role::path) noexcept;

    /// Tells that no more waypoints will come. Refused if there was no move at all.
    Status finish() noexcept;

protected:
    static constexpr std::uint64_t capacity = 32; ///< knots in the ring: 16 of look-ahead, the end of the run, and some
                                                  ///< reserve

    explicit WaypointCurve(const CurveOptions<S>& options) noexcept : options_(options) {}
    ~WaypointCurve() = default;

    [[nodiscard]] Knot<S>& knot(std::uint64_t i) noexcept { return ring_[i % capacity]; }
    [[nodiscard]] const Knot<S>& knot(std::uint64_t i) const noexcept { return ring_[i % capacity]; }
    /// Whether `breaks` of knot i is final.
    [[nodiscard]] bool decided(std::uint64_t i) const noexcept { return i + 1 < known_ || (finished_ && i < known_); }
    /// Whether it is known where the segment i -> i+1 ends, and how; `item`: yes.
    [[nodiscard]] Pull ready(std::uint64_t i) const noexcept {
        if (i + 1 >= known_) {
            return finished_ ? Pull::finished : Pull::starved;
        }
        return decided(i + 1) ? Pull::item : Pull::starved;
    }
    /// Whether segment i -> i+1 is delivered: neither lead-in nor lead-out, except for the two segments at the seam.
    [[nodiscard]] bool travelled(std::uint64_t i) const noexcept {
        const bool enters = knot(i).role != Role::lead_in || (options_.seam_segments && knot(i + 1).role == Role::path);
        const bool leaves =
            knot(i + 1).role != Role::lead_out || (options_.seam_segments && knot(i).role == Role::path);
        return enters && leaves;
    }
    /// Fills all of a segment i -> i+1 except the control points.
    void describe_segment(std::uint64_t i, int degree, CurveSegment<S>& out) const noexcept;
    /// Number of axes of the curve.
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
