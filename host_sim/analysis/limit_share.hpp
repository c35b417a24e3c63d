// SPDX-License-Identifier: MIT
// LimitShare: which limits bound, and for which share of the time, measured on the emitted segments.
#pragma once

#include "host_sim/analysis/limit_kind.hpp"
#include "host_sim/config/machine_description.hpp"

#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace splinefeed::host {

/// Shares of the time, 0 to 1. Several limits may bind at the same time (an axis and the feed on a straight line), so
/// the sum may exceed 1. `none` is the share in which no limit binds: where the plan stays below all limits, and where
/// the machine stands for nobody.
struct LimitShares {
    struct Axis {
        double velocity = 0.0;
        double acceleration = 0.0;
        std::optional<double> jerk; ///< nothing: the machine file has no such limit; the same below
    };
    std::vector<Axis> axis; ///< in the order of the machine file
    double feed = 0.0;
    double programmed_feed = 0.0; ///< the part of `feed` in which the program's feed was below the machine's
    std::optional<double> centripetal;
    std::optional<double> chord;
    double none = 0.0;
    double override_feed = 0.0; ///< the part of `feed` in which the operator's override was the limit
    double hold = 0.0;          ///< the operator brakes the machine, or keeps it at rest
    double dwell = 0.0;         ///< the program keeps it at rest
};

/// What the operator and the program ask for on top of the moves.
struct OperatorState {
    double override_feed = 1.0;             ///< factor of the feeds, not of rapids
    LimitKind standstill = LimitKind::none; ///< hold: the machine brakes for it or stands; dwell
};

/// Which kinds of limits bound a segment.
struct BoundLimits {
    bool feed = false;
    bool velocity = false;     ///< of an axis
    bool acceleration = false; ///< or jerk, or what turning allows
};

/// A limit binds where at least 95 % of it is used: a plan that stays a few percent below a limit is still bound by it.
/// Measured in the middle of each segment, with the duration of that segment: the resolution is a segment (at most a
/// sample period). Speed along the path and curvature are taken over all axes, as in the plan. Memory: the waypoints
/// between the curve and the motion. Cost: below 0.1 us per segment.
class LimitShare {
public:
    static constexpr double binding = 0.95;

    explicit LimitShare(const MachineSettings& machine);

    /// The programmed feed on the way to a waypoint; 0: the machine's feed. Call it in the order of travel, before the
    /// segments that lead there.
    void programmed(std::uint32_t waypoint, double feed_mm_s, bool rapid = false);

    void segment(const FeedSegment& segment, const OperatorState& steered = {});

    /// Of the last segment.
    [[nodiscard]] const BoundLimits& bound() const noexcept { return bound_; }
    /// The limit that the last segment used most, if it bound.
    [[nodiscard]] BindingLimit binding_limit() const noexcept { return most_used_ >= binding ? most_ : BindingLimit{}; }
    /// The feed that is wanted of the last segment: the program's, or the machine's where that is lower.
    [[nodiscard]] double feed_mm_s() const noexcept {
        return feeds_.empty() ? machine_.max_feed_mm_s : feeds_.front().mm_s;
    }
    [[nodiscard]] LimitShares shares() const;

private:
    struct Axis {
        double mm_per_unit = 0.0;
        std::uint64_t velocity = 0; // ticks
        std::uint64_t acceleration = 0;
        std::uint64_t jerk = 0;
    };
    struct Feed {
        std::uint32_t waypoint;
        double mm_s;
        bool rapid;
    };

    MachineSettings machine_;
    unsigned axes_;
    double chord_mm_s2_; // largest kappa v^2 that the chord error allows
    PerAxis<Axis> axis_{};
    std::deque<Feed> feeds_;
    BoundLimits bound_{};
    BindingLimit most_{};
    double most_used_ = 0.0;
    std::uint64_t feed_ = 0;
    std::uint64_t programmed_ = 0;
    std::uint64_t override_ = 0;
    std::uint64_t hold_ = 0;
    std::uint64_t dwell_ = 0;
    std::uint64_t centripetal_ = 0;
    std::uint64_t chord_ = 0;
    std::uint64_t none_ = 0;
    std::uint64_t total_ = 0;
};

} // namespace splinefeed::host
