// SPDX-License-Identifier: MIT
// TimeRate: the rate at which a ring of segments is executed, sigma of docs/reference/pvt_map.md: it falls to 0 at the
// end of the ring.
#pragma once

namespace splinefeed::host {

/// Everything is in closed form: except for rounding, the result does not depend on how time is divided into calls.
class TimeRate {
public:
    /// The motion that lies ahead, and the request.
    struct Way {
        double ring_s = 0.0;      ///< R: time to the end of the ring at full rate
        double segment_s = 0.0;   ///< time to the end of the segment, at most ring_s
        bool ends_moving = false; ///< no segment in the ring ends with standstill of all axes: the end of the ring
                                  ///< limits the rate
        bool holds = false;       ///< the rate has to fall to 0, wherever that is
    };
    struct Passed {
        double time_s = 0.0;
        double way_s = 0.0;  ///< in the segments' own time
        bool at_end = false; ///< the end of the segment was reached: way_s is its segment_s
    };

    /// @pre stop_reserve_s > 0
    void set_stop_reserve(double stop_reserve_s) noexcept { reserve_s_ = stop_reserve_s; }
    /// At standstill of all axes any rate is right: takes the largest that the ring allows.
    void start(const Way& way) noexcept;
    /// Called where a segment ends with standstill of all axes: lowers the rate if the rest of the ring needs it.
    void pass_rest(const Way& way) noexcept;
    /// Whether the rate can fall to 0 within that distance.
    [[nodiscard]] bool stops_within(double way_s) const noexcept {
        return rate_ * rate_ * reserve_s_ <= way_s * (1.0 + 1e-9);
    }
    void stop() noexcept { rate_ = 0.0; }
    /// Lets time pass, up to the end of the segment, or to the standstill of a hold. @pre time_s >= 0
    [[nodiscard]] Passed pass(double time_s, const Way& way) noexcept;

    [[nodiscard]] double rate() const noexcept { return rate_; }

private:
    struct Phase {
        double slope = 0.0; // slope of the rate [1/s]
        double time_s = 0.0;
        double end_rate = 0.0;
    };
    [[nodiscard]] Phase phase(const Way& way) noexcept;
    [[nodiscard]] double largest(const Way& way) const noexcept;

    double reserve_s_ = 0.1;
    double rate_ = 0.0;
};

} // namespace splinefeed::host
