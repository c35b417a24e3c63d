// SPDX-License-Identifier: MIT
// RunTarget: where a run's feed segments go in real time, beside the simulated machine that proves them.
#pragma once

#include "machine_description.hpp"
#include "summary.hpp"

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
struct RunWishes {
    bool home = false;  ///< the axes find their references before they move
    bool probe = false; ///< it ends, held on the path, where the probe touches
};

/// What the user asks for by signals.
enum class UserSteering { none, hold, resume };

/// While one lives, SIGINT, SIGTERM and SIGHUP are a feed hold of all axes, for the second time a quick stop; the run
/// then ends. SIGUSR1 is a feed hold and SIGUSR2 the end of it.
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
    /// Adds what it knows of the run.
    virtual void describe(Summary& summary) const = 0;
    /// Why the motion is to be held on its path, and ends there; empty: it is not.
    [[nodiscard]] virtual std::string holds() const { return {}; }
    /// And whether that was what the run was for.
    [[nodiscard]] virtual bool achieved() const { return false; }
    /// The last thing that was asked for and not taken yet.
    [[nodiscard]] static UserSteering take_steering();

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
    /// All axes stop on the path: at once, or by holds().
    virtual void hold() { port().halt(); }
    virtual void quick_stop() = 0;
    /// Each time that the run looks after its port.
    virtual void look() {}
    /// Why the port is in fault.
    [[nodiscard]] virtual std::string fault() const = 0;

    bool poll();

    std::string why_;
    hal::PortPhase phase_ = hal::PortPhase::running;
    bool prepared_ = false;
    int halts_ = 0; // interrupts that were obeyed
};

/// Connects to the drives of --target. `machine` must outlive it. Throws UsageError, InputError, TargetError.
[[nodiscard]] std::unique_ptr<RunTarget> make_run_target(const std::string& target, const MachineDescription& machine,
                                                         const RunWishes& wishes);

} // namespace splinefeed::host
