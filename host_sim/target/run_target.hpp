// SPDX-License-Identifier: MIT
// RunTarget: where a run's feed segments go in real time, beside the simulated machine that proves them.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/output/summary.hpp"

#include "splinefeed/hal/motion_port.hpp"

#include <memory>
#include <stdexcept>
#include <string>

namespace splinefeed::host {

/// A target that cannot be used: nothing has moved. The tool then exits with 1.
struct TargetError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// What a run asks of its target besides moving.
struct RunOptions {
    bool home = false;  ///< the axes find their references before they move
    bool probe = false; ///< it ends, held on the path, where the probe touches
};

/// What Supervision looks after. From the first segment on, its thread alone calls what is not const.
class RunTarget {
public:
    RunTarget() = default;
    RunTarget(const RunTarget&) = delete;
    RunTarget& operator=(const RunTarget&) = delete;
    virtual ~RunTarget() = default;

    /// The shortest segments that it takes. [us]
    [[nodiscard]] virtual double least_segment_us() const noexcept = 0;
    /// Whether a run may have longer segments than the machine file asks for.
    [[nodiscard]] virtual bool resamples() const noexcept = 0;
    /// Lowers limits of the machine that its drives cannot follow, before anything is planned. What it lowered, in a
    /// line; empty: nothing.
    [[nodiscard]] virtual std::string fit(MachineDescription& /*machine*/) const { return {}; }
    /// Whether it carries the machine's velocities and positions in segments that long. Throws UsageError with the
    /// axis, its value and the range; nothing has moved.
    virtual void check(const MachineDescription& /*machine*/, double /*segment_us*/) const {}
    /// What the user should know before anything moves, in a line; empty: nothing.
    [[nodiscard]] virtual std::string note() const { return {}; }

    [[nodiscard]] virtual hal::MotionPort& port() noexcept = 0;
    /// Makes all ready for the first segment, which defines where the axes stand. May take minutes (homing); ends when
    /// SignalWatch::interrupts() grows. Empty, or what is wrong.
    [[nodiscard]] virtual std::string prepare(const FeedSegment& first) = 0;
    /// No more segments come.
    virtual void complete() = 0;
    /// The user wants an end: all axes stop on the path.
    virtual void hold() { port().halt(); }
    /// For the second time: at once.
    virtual void quick_stop() = 0;
    /// Before each poll of the port.
    virtual void update() {}
    /// Why the plan is to be held on its path, and ends there; empty: it is not. A planner that does not deliver the
    /// way to standstill in time is the target's business: its port becomes halted then.
    [[nodiscard]] virtual std::string holds() const { return {}; }
    /// And whether that was what the run was for.
    [[nodiscard]] virtual bool achieved() const { return false; }
    /// Why the port is in fault.
    [[nodiscard]] virtual std::string fault() const = 0;
    /// How the axes were stopped, after hold() or quick_stop().
    [[nodiscard]] virtual std::string halted(bool quick) const = 0;
    /// Once, when a motion that prepare() began is over, however it ended: the drives are left as the machine file says
    /// (drives_at_end), those that stand. Returns what was not confirmed, in a line.
    [[nodiscard]] virtual std::string finish() = 0;
    /// Before the process ends without destructors: what drives and lines are to be left at.
    virtual void release() noexcept = 0;

    /// "; the machine stands at x=1.0000 y=2.0000 mm", by what the drives say.
    [[nodiscard]] virtual std::string where() const = 0;
    /// Adds what it knows of the run.
    virtual void describe(Summary& summary) const = 0;
};

} // namespace splinefeed::host
