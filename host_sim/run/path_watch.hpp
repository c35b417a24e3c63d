// SPDX-License-Identifier: MIT
// PathWatch: shows the curve to the objects that check, measure and write it. ProgramObserver: shows the steps of a
// program to those who write or count them.
#pragma once

#include "host_sim/analysis/limit_share.hpp"
#include "host_sim/analysis/optimum_time.hpp"
#include "host_sim/analysis/path_deviation.hpp"
#include "host_sim/analysis/program_report.hpp"
#include "host_sim/analysis/waypoint_error.hpp"
#include "host_sim/base/background_work.hpp"
#include "host_sim/base/input_error.hpp"
#include "host_sim/output/curve_writer.hpp"
#include "host_sim/output/element_writer.hpp"
#include "host_sim/planning/path_feeder.hpp"
#include "host_sim/planning/path_limits.hpp"
#include "host_sim/report/motion_record.hpp"

namespace splinefeed::host {

/// The objects that see the curve; null: not used.
struct PathObservers {
    const PathLimits* limits = nullptr;
    CurveWriter* writer = nullptr;
    WaypointError* error = nullptr;
    PathDeviation* deviation = nullptr;
    OptimumTime* optimum = nullptr;
    BackgroundWork* work = nullptr; ///< does what `deviation` and `optimum` do; null: it is done at once
    LimitShare* share = nullptr;
};

/// The path leaves the travel of an axis, or what its counter counts.
struct TravelError : InputError {
    using InputError::InputError;
};

/// Refuses a segment that leaves the limits, or cannot be written: TravelError, OutputError.
class PathWatch final : public CurveWatch {
public:
    /// `file`: the name of the input for messages. All arguments must outlive it.
    PathWatch(const std::string& file, const PathObservers& observers) noexcept : file_(&file), observers_(observers) {}

    void segment(const CurveSegment<double>& segment, std::uint32_t row, const PathFeeder& feeder) override;

private:
    void measure(const CurveSegment<double>& segment) const;

    const std::string* file_;
    PathObservers observers_;
};

class ProgramObserver {
public:
    /// Null: not used. All must outlive it.
    ProgramObserver(ElementWriter* writer, ProgramReport* report, MotionRecord* record)
        : writer_(writer), report_(report), record_(record) {}

    /// What the feeder has read. Throws OutputError.
    void see(const PathFeeder::Pushed& pushed);

private:
    static void write(const PathFeeder::Pushed& pushed, ElementWriter& writer);
    static void tell(const PathFeeder::Pushed& pushed, ProgramReport& report);

    ElementWriter* writer_;
    ProgramReport* report_;
    MotionRecord* record_;
};

} // namespace splinefeed::host
