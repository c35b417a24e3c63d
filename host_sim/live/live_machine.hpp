// SPDX-License-Identifier: MIT
// LiveMachine: a machine in motion, whoever drives it: a program (run) or people (serve).
#pragma once

#include "host_sim/base/abandon.hpp"
#include "host_sim/base/signal_watch.hpp"
#include "host_sim/live/state_keeper.hpp"
#include "host_sim/live/target_feed.hpp"

#include "splinefeed/controller/controlled_machine.hpp"

#include <deque>
#include <functional>
#include <memory>
#include <mutex>

namespace splinefeed::host {

/// Its own thread supervises the port: each millisecond it looks at stops, switches, drives and outputs, whatever the
/// planner does. Each motion, from standstill to standstill, is one of the port.
///
///     closed --open, read where it stands--> open --the first segment--> ready --the motion's end--> ready, or the end
///        ^                                    |                            |
///        +---- drives off, or a reset --------+------- failed <------------+ a fault, a stop that is not confirmed
///
/// A machine that is served has many motions: behind the end of one the port is renewed at once, and the drives stay
/// on. A run has one motion. Its end is the machine's, whatever the reason: everything was executed, a signal, the
/// target, the outputs' own trouble, a plan that was given up with stop(), an exception of the target.
///
/// A machine ends once. All axes are held and stand, the outputs of the program - spindle, coolant, digital outputs -
/// are told to end, and the drives are left as the machine file says. Then the outputs have ended, the state file has
/// the places, and ending() says what is true. Each step is bounded. Outputs end earlier, before the axes stand, when a
/// drive is in fault and at the second request.
///
/// Nothing moves before the state file says that its place is not known. Nobody waits for that: what begins a motion is
/// kept back, stops go through, and what was kept back is then forgotten.
///
/// If a run ends early and the planner does not return within stall_s because an output is blocked, the thread ends the
/// process with the run's message and exit status 1. After the end of a run a signal does this at once.
class LiveMachine final : public ControlledMachine {
public:
    using MakeOutputs = std::function<std::unique_ptr<ProgramOutputs>()>;

    static constexpr std::uint64_t hand_over_us = TargetFeed::hand_over_us;
    static constexpr int stall_s = 2;

    /// Pointers must outlive it.
    struct Settings {
        std::uint32_t segment_ticks = 0;          ///< of its plans
        SignalWatch* signals = nullptr;           ///< of a run, which has one motion; null: it is served
        StateKeeper* state = nullptr;             ///< null: nothing is kept. Of a server it writes behind
        TargetRecord* record = nullptr;           ///< null: nobody looks
        bool simulates = false;                   ///< it has all outputs that are asked for, as in a simulated run
        PerAxis<double> told_mm{};                ///< where axes stand that do not know it
        std::uint32_t told = 0;                   ///< axes that stand there indeed, by bits, if they cannot be asked
        hal::Clock* clock = &hal::system_clock(); ///< that of its thread
    };

    /// The thread of a run begins with the first segment. That of a machine that is served begins at once, behind a
    /// look at where it stands: a drive in fault is an alarm.
    /// @param target, machine  must outlive it
    /// @param outputs  makes them, or null where there are none; called again behind a reset that ended them
    LiveMachine(RunTarget& target, const MachineDescription& machine, const Settings& settings, MakeOutputs outputs);
    /// A machine of which nobody expects anything but that it takes what is submitted: that of a plan.
    LiveMachine() = default;
    LiveMachine(const LiveMachine&) = delete;
    LiveMachine& operator=(const LiveMachine&) = delete;
    /// If it has not ended: stop(), and waits for the end.
    ~LiveMachine();

    /// What searches for references poll while a machine is served: RunOptions::interrupted.
    [[nodiscard]] static bool gives_up() noexcept { return gives_up_.load() || SignalWatch::interrupted(); }

    // For the planner's thread:

    /// Whether there is a machine: not that of a plan.
    [[nodiscard]] bool is_real() const noexcept { return target_ != nullptr; }
    /// Whether submit() would return without waiting.
    [[nodiscard]] bool has_room() const noexcept { return !is_real() || feed_->room(); }
    /// It has so little motion left that the plan must not wait for more.
    [[nodiscard]] bool is_dry() const;
    /// Passes a segment on, as soon as there is room for it. The first one of a run defines where the axes stand.
    /// false: the machine has ended. Throws OutputError if the state file cannot be written; nothing has moved then.
    /// @param line  of the program, that the segment comes from; 0: unknown
    /// @param moves  of the program up to this one, or waypoints; for Reached
    bool submit(const FeedSegment& segment, std::uint64_t line, std::uint64_t moves);
    bool submit(const FeedSegment& segment) { return submit(segment, 0, segment.waypoint); }
    /// Nothing follows the last segment for now. If it ends at rest, the motion is complete there; otherwise nobody can
    /// say how it goes on, and this is a stop().
    void rest();
    /// The plan of a run is given up: all axes stop as after the first signal, and it ends.
    /// @param why  for the message
    void stop(const std::string& why = {});
    /// The end, if it has not come: of a run behind rest(). Returns why it ended before everything was executed, or
    /// what was not confirmed; empty: neither.
    const std::string& finish();
    [[nodiscard]] bool over() const noexcept { return over_.load(); }
    /// Whether it has begun and is not over.
    [[nodiscard]] bool runs() const noexcept { return thread_ != nullptr && !over(); }

    /// The outputs get the order when everything that was submitted before is executed, in order.
    /// @param standing  the machine stands there: it has done so for a moment then
    void order(const ProgramAction& action, bool standing);
    /// Whether all orders are carried out: the spindle has its speed, the input has answered.
    [[nodiscard]] bool carried_out() const { return !is_real() || feed_->carried_out(); }
    /// The answer of the last M66: 0 or 1, -1 after its time-out. @pre it was ordered, and carried_out()
    [[nodiscard]] int input() const { return feed_->answer(); }
    /// Whether the spindle is known to stand.
    [[nodiscard]] bool spindle_stands() const;

    /// Whether the plan has to be held, and ends there.
    [[nodiscard]] bool hold_asked() const noexcept { return is_real() && feed_->hold_asked(); }
    [[nodiscard]] UserSteering take_steering() const noexcept {
        return settings_.signals != nullptr ? settings_.signals->take_steering() : UserSteering::none;
    }
    /// Segments that were submitted, and those that were executed.
    [[nodiscard]] std::uint64_t submitted() const noexcept { return is_real() ? feed_->pushed() : 0; }
    [[nodiscard]] std::uint64_t executed() const noexcept { return is_real() ? feed_->executed() : 0; }
    /// What the machine has come to, while it moves.
    struct Reached {
        std::uint64_t line = 0;
        std::uint64_t moves = 0;
    };
    [[nodiscard]] Reached reached() const;
    [[nodiscard]] bool stands() const;
    /// Where the axes stand, as far as it is known. Of a run it is of the last tenth of a second; empty: nothing has
    /// moved.
    [[nodiscard]] std::vector<RunTarget::AxisPlace> places() const;

    /// As finish() returned it.
    [[nodiscard]] const std::string& ending() const noexcept { return ending_; }
    /// "; the machine stands at ..." @pre over()
    [[nodiscard]] const std::string& where() const noexcept { return where_; }
    void describe(Summary& summary) const;
    /// Of a machine that is served and stands: the state gets its places, if it does not have them.
    void keep();

    // For the controller:

    MachineReading read() noexcept override;
    void obey(const ProgramEvent& event) noexcept override;
    [[nodiscard]] bool has_output(EventKind kind, std::int32_t number) const noexcept override;
    void forget_input() noexcept override;
    void watch_probe(bool away) noexcept override;
    void home(std::uint32_t axes) noexcept override;
    bool halt() noexcept override;
    void quick_stop() noexcept override;
    void enable(bool on) noexcept override;
    void reset_faults() noexcept override;

private:
    static constexpr std::uint64_t poll_every_us = 1000;

    enum class Phase : std::uint8_t { closed, open, ready, failed };
    /// What other threads ask for; that of the machine does it, in this order.
    struct Orders {
        hal::StopRequest stop = hal::StopRequest::none;
        bool off = false;            ///< the drives
        bool opens = false;          ///< what is closed or has failed
        bool resets = false;         ///< faults of drives, too
        std::uint32_t home = 0;      ///< axes
        std::optional<bool> probe{}; ///< RunTarget::watch_probe()

        [[nodiscard]] bool any() const noexcept { return off || opens || home != 0; }
    };
    /// What the thread knows, for others.
    struct Known {
        PerAxis<double> mm{};
        std::uint32_t axes = 0; ///< by bits: those of which that is the machine's
        HomingPhase homing = HomingPhase::none;
        Alarm alarm = Alarm::none;
        std::string sentence{};
        double speed_mm_s = 0.0;
        RunTarget::Switches switches{};
        std::vector<RunTarget::AxisPlace> places{}; ///< of a run, as the target tells them
        std::string note{};                         ///< a drive has been silent for a while
    };
    struct Label {
        std::uint64_t line = 0;
        std::uint64_t moves = 0;
        std::uint64_t segment = 0; // its first one
    };

    [[nodiscard]] bool serves() const noexcept { return settings_.signals == nullptr; }
    [[nodiscard]] std::uint32_t all_axes() const noexcept {
        return (1U << static_cast<unsigned>(machine_->settings.axes)) - 1U;
    }

    // live_machine.cpp
    void set_known(std::uint32_t axes) noexcept;
    void begin_label(std::uint64_t line, std::uint64_t moves);
    void begin_to_move();
    void give_up_homing() noexcept;
    void start();
    void leave() noexcept;
    // live_thread.cpp
    void work() noexcept;
    void step();
    void look_at_signs(bool announces);
    void announce(const RunTarget::Stop& stop);
    [[nodiscard]] Orders take_orders();
    [[nodiscard]] bool may_move();
    void come_to(std::uint64_t executed);
    void end_motion(const MotionEnd& end);
    void finish_motion();
    void drop_motion();
    [[nodiscard]] Alarm trouble_alarm() const;
    void fail(const std::string& sentence, Alarm alarm = Alarm::drive_fault);
    void fail_by(const std::string& sentence);
    bool look_where(bool at_once);
    void take_place(const FeedSegment& segment);
    void note_silence(const std::vector<RunTarget::AxisPlace>& places, std::uint64_t now_us);
    void end() noexcept;
    [[nodiscard]] std::string outputs_end();
    void await_planner() noexcept;
    // live_ready.cpp
    void find_place();
    void begin_first();
    void begin_run();
    [[nodiscard]] hal::PortFailure make_ready(const FeedSegment& first);
    [[nodiscard]] FeedSegment standing() const;
    [[nodiscard]] std::uint32_t known_axes() const;
    void close();
    void reopen();
    void recover(bool resets);
    void renew_outputs();
    void switch_off();
    void find_references(std::uint32_t axes);

    static std::atomic<bool> gives_up_;

    RunTarget* target_ = nullptr;
    const MachineDescription* machine_ = nullptr;
    Settings settings_{};
    TargetFacts facts_{};
    MakeOutputs make_outputs_;
    std::unique_ptr<ProgramOutputs, DeleteInTime> outputs_;
    std::optional<TargetFeed> feed_;
    // Of the planner's thread:
    std::string sentence_;                         // of the last reading,
    std::string note_;                             // likewise
    bool at_rest_ = true;                          // at the end of the last segment,
    bool rests_ = true;                            // and rest() was called behind it
    std::atomic<std::uint64_t> least_ahead_us_{0}; // RunTarget::Signs
    std::atomic<bool> over_{false};
    std::atomic<std::uint64_t> stands_from_us_{0}; // the spindle of outputs that are gone
    // Shared:
    mutable std::mutex mutex_; // protects the members below
    Orders orders_;
    Known known_;
    std::deque<Label> labels_;        // from that of the segment where the machine is
    std::uint32_t unlocked_axes_ = 0; // stand where they are told to when the operator moves them: the others are found
    std::string stop_why_;
    std::uint64_t submitted_ = 0; // segments
    std::uint64_t finished_ = 0;  // of motions that are over
    bool busy_ = false;           // an order is carried out
    bool moves_ = false;          // something has moved since the state was told the places
    bool waits_ = false;          // nothing does before the file says that no place is known; stops go through
    std::vector<RunTarget::AxisPlace> kept_places_; // that the state has
    // Of the thread, and after over_ of any thread:
    Phase phase_ = Phase::closed;
    hal::PortOrders ready_{.stays = true};
    std::uint64_t looked_us_ = 0;    // where it stands
    std::uint64_t heard_us_ = 0;     // of all drives
    std::uint64_t seen_ = 0;         // segments that were executed,
    std::uint64_t moved_us_ = 0;     // when that changed
    std::atomic<bool> stalls_{true}; // it has not for a while: the port waits for more, or has not begun
    std::uint64_t coasts_until_us_ = 0;
    std::string lost_outputs_; // what outputs had not confirmed that could not be made anew
    std::string reason_;       // why a run ends; empty: all was executed
    bool ends_ = false;        // the run does
    std::string ending_;
    std::string where_;
    std::atomic<bool> leaves_{false}; // the planner's thread needs no other thread any more
    std::unique_ptr<hal::ClockThread> thread_;
};

} // namespace splinefeed::host
