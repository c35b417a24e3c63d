// SPDX-License-Identifier: MIT
// TimeRate: how fast a ring of segments is executed, sigma of docs/reference/pvt_map.md: it falls to 0 at the ring's
// end.
#pragma once

namespace splinefeed::host {

/// All in closed form: how time is cut into calls does not matter, but for rounding.
class TimeRate {
public:
    /// What lies ahead, and what is wanted.
    struct Way {
        double ring_s = 0.0;      ///< R: to the end of the ring at full rate
        double segment_s = 0.0;   ///< to the end of the segment, at most ring_s
        bool ends_moving = false; ///< nothing in the ring is a place to stand: its end limits the rate
        bool holds = false;       ///< down to 0, wherever that is
    };
    struct Passed {
        double time_s = 0.0;
        double way_s = 0.0;  ///< of the segments' own time
        bool at_end = false; ///< of the segment: way_s is its segment_s
    };

    /// @pre stop_reserve_s > 0
    void set_stop_reserve(double stop_reserve_s) noexcept { reserve_s_ = stop_reserve_s; }
    /// Where the axes are at rest any rate is right: the largest that the ring allows.
    void start(const Way& way) noexcept;
    /// At a place to stand on the way: lower, where what follows needs it.
    void pass_rest(const Way& way) noexcept;
    /// Whether it can fall to 0 within that way at its slope.
    [[nodiscard]] bool stops_within(double way_s) const noexcept {
        return rate_ * rate_ * reserve_s_ <= way_s * (1.0 + 1e-9);
    }
    void stop() noexcept { rate_ = 0.0; }
    /// Lets time pass, up to the end of the segment, or to where a hold stands still. @pre time_s >= 0
    [[nodiscard]] Passed pass(double time_s, const Way& way) noexcept;

    [[nodiscard]] double rate() const noexcept { return rate_; }

private:
    struct Phase {
        double slope = 0.0; // of the rate [1/s]
        double time_s = 0.0;
        double end_rate = 0.0;
    };
    [[nodiscard]] Phase phase(const Way& way) noexcept;
    [[nodiscard]] double largest(const Way& way) const noexcept;

    double reserve_s_ = 0.1;
    double rate_ = 0.0;
};

} // namespace splinefeed::host
