// SPDX-License-Identifier: MIT
// CyclicStream: converts one axis of a motion to cyclic target positions.
#pragma once

#include "splinefeed/hal/modbus/setpoint/setpoint_frames.hpp"
#include "splinefeed/hal/modbus/setpoint/trajectory_buffer.hpp"

namespace splinefeed::hal::modbus {

struct CyclicSettings {
    int axis = 0;                   ///< index in the feed segments
    std::uint32_t period_us = 2000; ///< in which the drive moves to a target
    std::uint32_t interval_us = 0;  ///< between two frames, at most the period; 0: the period
    double acceleration = 1e6;      ///< for the return to the path after a time-out [counts/s^2]
    double fastest = 0.0;           ///< velocity limit of the axis [counts/s]; 0: targets are not limited
};

/// A drive that gets a target at t reaches it at t + P, the drive's period. The target extrapolates the path over an
/// interval I, when the next frame comes, to the whole period: p(t) + (p(t + I) - p(t)) P / I. It uses the instant at
/// which the drive's own frame arrives, so all axes of a line follow the same path although their frames come one after
/// the other. An error is multiplied by 1 - I / P with each frame.
///
/// Where the drive is follows from the targets that have arrived, but for when, and perhaps whether, each of them did.
/// No target is further from either end of that than `catch_up` times the fastest way of a period. A drive that missed
/// targets comes back to the path at that speed, and does not jump.
///
/// Deviation from the path with one frame per interval: line_deviation_counts
/// of the interval, plus half a unit of its register, times P / I if frames overlap. The drive moves straight between
/// frames. If a frame is late by more than P - I, the drive stops and waits for it.
class CyclicStream {
public:
    static constexpr double catch_up = 1.25; ///< of the velocity limit, for a drive behind the path

    /// The profile must outlive the stream. @pre the profile streams cyclic
    CyclicStream(const DriveProfile& profile, const CyclicSettings& settings);

    /// Returns the frame that arrives at this instant. @pre the track is not empty
    [[nodiscard]] std::span<const RegisterWrite> frame(const TrajectoryBuffer& track,
                                                       const MotionInstant& instant) noexcept;
    /// The same for a motion at full rate.
    [[nodiscard]] std::span<const RegisterWrite> frame(const TrajectoryBuffer& track,
                                                       std::uint64_t arrival_us) noexcept {
        return frame(track, {arrival_us, arrival_us, arrival_us + settings_.interval_us});
    }
    /// Where the drive stands before the first frame. From here on on_arrival() is called behind each frame.
    void begin(std::int64_t position_q16) noexcept;
    /// The last frame arrived between these instants [us]; the latest is UINT64_MAX: nobody knows whether it did.
    void on_arrival(std::uint64_t earliest_us, std::uint64_t latest_us) noexcept;
    /// Call when frames were missing for longer than the period: the drive stands at its last target. From the next
    /// frame on it returns to the path smoothly.
    void on_setpoint_timeout(const TrajectoryBuffer& track, const MotionInstant& instant) noexcept;
    /// Whether the last target was limited, or the drive still returns: it is behind the path.
    [[nodiscard]] bool behind() const noexcept { return limited_ || fading_us_ > 0.0; }
    /// Whether a target exceeded the range of its register and was clamped.
    [[nodiscard]] bool clamped() const noexcept { return clamped_; }
    /// Whether the drive has got the end of the motion as its target at that motion time.
    [[nodiscard]] bool end_sent(const TrajectoryBuffer& track, std::uint64_t motion_us) const noexcept {
        return !behind() && motion_us + settings_.interval_us >= track.end_us() &&
               (settings_.interval_us == settings_.period_us || motion_us >= track.end_us());
    }
    [[nodiscard]] SetpointFrames& frames() noexcept { return frames_; }

private:
    [[nodiscard]] double offset_q16(double elapsed_us) const noexcept;
    /// On its way to a target since that one arrived.
    struct Way {
        std::int64_t from_q16 = 0;
        std::int64_t to_q16 = 0;
        std::uint64_t since_us = 0;
    };
    [[nodiscard]] std::int64_t place_q16(const Way& way, std::uint64_t now_us) const noexcept;
    [[nodiscard]] std::int64_t within_reach(std::int64_t target_q16, std::uint64_t now_us) noexcept;

    CyclicSettings settings_;
    SetpointFrames frames_;
    std::int64_t target_q16_ = 0;     // the last target
    std::array<Way, 2> ways_{};       // the earliest and the latest that is possible
    double offset_q16_ = 0.0;         // distance from the path at the beginning of the return
    double fading_us_ = 0.0;          // duration of the return; 0: none
    std::uint64_t fades_from_us_ = 0; // when it began
    bool begun_ = false;              // the place of the drive is known
    bool limited_ = false;            // the last target is not on the path
    bool clamped_ = false;
};

} // namespace splinefeed::hal::modbus
