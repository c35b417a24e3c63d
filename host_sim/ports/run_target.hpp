// SPDX-License-Identifier: MIT
// RunTarget: where the feed segments of a run go in real time, in addition to the simulated machine that checks them: a
// port, and what the tool has to know and to say of it.
#pragma once

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/signal_watch.hpp"
#include "host_sim/config/machine_description.hpp"
#include "host_sim/output/summary.hpp"
#include "splinefeed/controller/alarm.hpp"
#include "splinefeed/hal/motion_port.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace splinefeed::host {

/// What a target has of switches, for the settings that senders ask for. Axes are bits.
struct SwitchFacts {
    std::uint32_t limits = 0;         ///< axes with limit switches
    std::uint32_t homes = UINT32_MAX; ///< that find a reference,
    std::uint32_t homes_low = 0;      ///< at their low end
    bool probe = false;
    std::uint32_t debounce_us = 0;
    double pull_off_mm = 0.0;
    double seek_mm_s = 0.0;  ///< of the slowest axis
    double latch_mm_s = 0.0; ///< likewise
    std::string no_home;     ///< of axes that find none, what would be right; empty: the controller's own sentence
};

/// What of a target does not change while it lives.
struct TargetFacts {
    double least_segment_us = 0.0; ///< duration of the shortest segments that it accepts
    bool resamples = false;        ///< a run may have longer segments than those of the machine file
    /// Its drives can be asked where they stand. false: what was told is all that is known, and they stay connected.
    bool has_feedback = true;
    bool halts = false; ///< halt() of the port stops the drives sooner than the plan could brake; else it asks for that
    /// The axes that search together with each, by bits: a drive homes all of its own. None: it finds no reference.
    PerAxis<std::uint32_t> homes_with{};
    SwitchFacts switches{};
    std::string note{}; ///< one line that the user should read before anything moves; empty: nothing

    [[nodiscard]] std::uint32_t search_of(std::uint32_t axes) const noexcept {
        std::uint32_t out = 0;
        for (const unsigned k : indices(max_axes)) {
            out |= (axes >> k & 1U) != 0 ? homes_with[k] : 0U;
        }
        return out;
    }
};

/// A target that cannot be used: nothing has moved. The tool then exits with status 1.
struct TargetError : TextError {
    using TextError::TextError;
};

/// What a run does when the machine stands elsewhere than its program begins.
enum class StartWay : std::uint8_t {
    check, ///< it is refused
    move,  ///< the machine moves there in a straight line
    here,  ///< where it stands is where the program begins
};

/// What a run needs from its target in addition to motion.
struct RunOptions {
    hal::PortOrders orders{}; ///< for prepare(), before the run moves
    bool probe = false;       ///< the run ends, held on the path, when the probe touches
    /// Polled while the axes find their references; true: the search ends. A plain function, for the ports.
    bool (*interrupted)() = &SignalWatch::interrupted;
    StartWay start = StartWay::check;
};

/// The interface that LiveMachine uses. From the first segment on, only its thread calls the functions that are not
/// const.
class RunTarget {
public:
    /// Where an axis of the machine stands, in machine coordinates.
    struct AxisPlace {
        unsigned axis = 0;
        /// As its drive reports it or, if it does not answer, last did. Nothing: it is not known, since the axis has
        /// moved without a reference, or lost it. [mm]
        std::optional<double> mm;
        /// false: the drive does not answer or may still move, so that the axis may be elsewhere by now.
        bool online = true;

        /// The place where the axis is known to stand now; nothing: there is none.
        [[nodiscard]] std::optional<double> known() const noexcept { return online ? mm : std::nullopt; }

        friend bool operator==(const AxisPlace&, const AxisPlace&) = default;
    };

    /// What stops the machine now, whether it moves or not, and the sentence about it.
    struct Stop {
        Alarm cause = Alarm::none;
        std::string why{};
    };
    /// Axes are bits.
    struct Switches {
        std::uint32_t limits = 0;
        bool probe = false;
        bool e_stop = false;
        std::optional<PerAxis<double>> touched_mm{}; ///< where the probe changed as watch_probe() asked
    };
    /// What it shows at a look.
    struct Signs {
        /// Why the plan has to be held on its path, and ends there; empty: it has not. If the planner does not deliver
        /// the way to standstill in time, the target deals with it: its port then becomes halted.
        std::string holds{};
        bool achieved = false; ///< this hold was the purpose of the run
        Stop stop{};
        Switches switches{};
        /// With less motion than this in the port it may slow down by itself, unless that is the end.
        std::uint64_t least_ahead_us = 20'000;
    };

    RunTarget() = default;
    RunTarget(const RunTarget&) = delete;
    RunTarget& operator=(const RunTarget&) = delete;
    virtual ~RunTarget() = default;

    /// What of it does not change while it lives.
    [[nodiscard]] virtual TargetFacts facts() const = 0;
    /// Before planning: lowers limits of the machine that its drives cannot follow. Returns one line that says what was
    /// lowered; empty: nothing.
    [[nodiscard]] virtual std::string fit(MachineDescription& /*machine*/) const { return {}; }
    /// Checks that the target can carry the machine's velocities and positions in segments of this duration. Throws
    /// UsageError with the axis, its value and the range; nothing has moved.
    virtual void check(const MachineDescription& /*machine*/, double /*segment_us*/) const {}

    /// All motion is its own, from prepare(), which ends early if SignalWatch::interrupts() grows, to close(). That one
    /// is called before the process ends without destructors, too: drives and lines are then in their final state.
    [[nodiscard]] virtual hal::MotionPort& port() noexcept = 0;
    /// Each millisecond, also while it stands.
    [[nodiscard]] virtual Signs signs() { return {}; }
    /// From now on the next contact of the probe, or the loss of it, is noted with its place.
    virtual void watch_probe(bool /*away*/) {}

    /// A failure of the port for the user, and what else is not as it should be.
    [[nodiscard]] virtual std::string sentence(const hal::PortFailure& failure) const { return failure.what; }
    /// How the axes were stopped by halt() or quick_stop() of the port.
    [[nodiscard]] virtual std::string halted(bool quick) const = 0;
    /// Drives that stand are left in the state that the machine file requires (drives_at_end), or off. Returns one line
    /// with everything that was not confirmed. @param off  whatever the file says: they sleep, and more motion may come
    [[nodiscard]] virtual std::string leave(bool off) = 0;

    /// Of every axis that the target moves, after prepare(). Empty: no axis has moved, nor been told to; what was known
    /// of its place before is still true.
    [[nodiscard]] virtual std::vector<AxisPlace> places() const { return {}; }
    /// Where every axis will stand behind prepare(), if its first segment begins there. Waits until the drives stand,
    /// and sends them no command. Empty: prepare() moves the axes to the first segment by itself. Call before
    /// prepare(). Throws TargetError.
    [[nodiscard]] virtual std::vector<AxisPlace> standing() { return {}; }
    /// "; the machine stands at x=1.0000 y=2.0000 mm": the same as a text.
    [[nodiscard]] virtual std::string where() const = 0;
    /// Adds its data about the run.
    virtual void describe(Summary& summary) const = 0;
};

} // namespace splinefeed::host
