// SPDX-License-Identifier: MIT
// RunTarget: where a run's feed segments go in real time, beside the simulated machine that proves them.
#pragma once

#include "link_summary.hpp"
#include "machine_description.hpp"

#include "splinefeed/hal/motion_port.hpp"

#include <memory>
#include <stdexcept>
#include <string>

namespace splinefeed::host {

/// A target that cannot be used: nothing has moved. The tool then exits with 1.
struct TargetError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// While one lives, SIGINT and SIGTERM are a feed hold of all axes, for the second time a quick stop; the run then
/// ends.
class RunTarget {
public:
    RunTarget(const RunTarget&) = delete;
    RunTarget& operator=(const RunTarget&) = delete;
    virtual ~RunTarget();

    /// The shortest segments that it takes. [us]
    [[nodiscard]] virtual double least_segment_us() const noexcept = 0;
    /// Whether a run may have longer segments than the machine file asks for.
    [[nodiscard]] virtual bool resamples() const noexcept = 0;
    /// What the user should know before anything moves, in a line; empty: nothing.
    [[nodiscard]] virtual std::string note() const { return {}; }

    /// Hands a segment on, when there is room for it; the first one defines where the axes stand.
    /// False: the run is over, why() says why.
    [[nodiscard]] bool submit(const FeedSegment& segment);
    /// Waits until everything is executed. False: as of submit().
    [[nodiscard]] bool finish();
    [[nodiscard]] const std::string& why() const noexcept { return why_; }
    /// "; the machine stands at x=1.0000 y=2.0000 mm", by what the drives say.
    [[nodiscard]] virtual std::string where() const = 0;
    [[nodiscard]] virtual LinkSummary link() const = 0;

protected:
    RunTarget();
    /// The user has asked for an end since this one was made.
    [[nodiscard]] static bool interrupted();

private:
    [[nodiscard]] virtual hal::MotionPort& port() noexcept = 0;
    /// Makes all ready for the first segment. Empty, or what is wrong.
    [[nodiscard]] virtual std::string prepare(const FeedSegment& first) = 0;
    /// No more segments come.
    virtual void complete() = 0;
    virtual void quick_stop() = 0;
    /// Why the port is in fault.
    [[nodiscard]] virtual std::string fault() const = 0;

    bool poll();

    std::string why_;
    hal::PortPhase phase_ = hal::PortPhase::running;
    bool prepared_ = false;
    int halts_ = 0; // interrupts that were obeyed
};

/// Connects to the drives of --target. `machine` must outlive it. Throws UsageError, InputError, TargetError.
/// @param home  the axes find their references before they move
[[nodiscard]] std::unique_ptr<RunTarget> make_run_target(const std::string& target, const MachineDescription& machine,
                                                         bool home);

} // namespace splinefeed::host
