// SPDX-License-Identifier: MIT
// CyclicStream: one axis of a motion as cyclic target positions.
#pragma once

#include "splinefeed/hal/modbus/setpoint/setpoint_frames.hpp"
#include "splinefeed/hal/modbus/setpoint/trajectory_buffer.hpp"

namespace splinefeed::hal::modbus {

struct CyclicSettings {
    int axis = 0;                   ///< of the feed segments
    std::uint32_t period_us = 2000; ///< that the drive takes to get to a target
    std::uint32_t interval_us = 0;  ///< between two frames, at most the period; 0: the period
    double acceleration = 1e6;      ///< with which it comes back to the path [counts/s^2]
};

/// A drive that gets a target at t is there at t + period P. It is told to go as it must to be where the path is when
/// the next frame comes, an interval I later, and on for the rest of the period: p(t) + (p(t + I) - p(t)) P / I. The
/// instant at which its own frame arrives counts, so all axes of a line speak of the same path, though they are told
/// one after the other; what it is off dies out by 1 - I / P from frame to frame.
///
/// How near it stays to the path where frames come once an interval: between two it goes straight,
/// line_deviation_counts of the interval; plus half a unit of its register, P / I of it where frames overlap. A frame
/// that is late by no more than P - I finds it still moving; beyond it stands.
class CyclicStream {
public:
    /// The profile must outlive it. @pre it streams cyclic
    CyclicStream(const DriveProfile& profile, const CyclicSettings& settings);

    /// The frame that arrives at this instant. @pre the track is not empty
    [[nodiscard]] std::span<const RegisterWrite> frame(const TrajectoryBuffer& track,
                                                       const MotionInstant& instant) noexcept;
    /// The same while the motion runs at its full rate.
    [[nodiscard]] std::span<const RegisterWrite> frame(const TrajectoryBuffer& track,
                                                       std::uint64_t arrival_us) noexcept {
        return frame(track, {arrival_us, arrival_us, arrival_us + settings_.interval_us});
    }
    /// Its frames were lost for longer than the period: it stands where it was told to be last. From the next frame on
    /// it comes back to the path, smoothly.
    void on_setpoint_timeout(const TrajectoryBuffer& track, const MotionInstant& instant) noexcept;
    /// A register could not hold a target: it was clamped.
    [[nodiscard]] bool clamped() const noexcept { return clamped_; }
    /// At that time of the motion the drive has been told where it ends.
    [[nodiscard]] bool end_sent(const TrajectoryBuffer& track, std::uint64_t motion_us) const noexcept {
        return fading_us_ == 0.0 && motion_us + settings_.interval_us >= track.end_us() &&
               (settings_.interval_us == settings_.period_us || motion_us >= track.end_us());
    }
    [[nodiscard]] SetpointFrames& frames() noexcept { return frames_; }

private:
    [[nodiscard]] double offset_q16(double elapsed_us) const noexcept;

    CyclicSettings settings_;
    SetpointFrames frames_;
    std::int64_t target_q16_ = 0; // the last one
    double offset_q16_ = 0.0;     // from the path, when it came back
    double fading_us_ = 0.0;      // for how long it fades
    double elapsed_us_ = 0.0;     // of it
    bool clamped_ = false;
};

} // namespace splinefeed::hal::modbus
