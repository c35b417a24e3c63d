// SPDX-License-Identifier: MIT
// ServedTarget: a real target, for a controller: drives on Modbus, lines of GPIO chips.
#pragma once

#include "host_sim/base/signal_watch.hpp"
#include "host_sim/run/target_feed.hpp"
#include "host_sim/serve/served_machine.hpp"

#include "splinefeed/hal/rt/clock.hpp"

#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>

namespace splinefeed::host {

/// Its own thread supervises the port, as that of a run does, by the same TargetFeed: stops and switches act whatever
/// the server does. Each motion, from standstill to standstill, is one of the port; behind its end the port is renewed
/// at once. The drives are enabled when the first motion begins, and stay so.
///
///     closed --open, read where it stands--> open --the first segment--> ready <--> motions
///        ^                                    |                            |
///        +---- drives off, or a reset --------+------- failed <------------+ a fault, a stop that is not confirmed
class ServedTarget final : public ServedMachine {
public:
    using MakeOutputs = std::function<std::unique_ptr<ProgramOutputs>()>;

    struct Settings {
        std::uint32_t segment_ticks = 0;          ///< of its plans
        PerAxis<double> told_mm{};                ///< where axes stand that do not know it
        std::uint32_t told = 0;                   ///< axes that stand there indeed, by bits, if they cannot be asked
        hal::Clock* clock = &hal::system_clock(); ///< must outlive it
    };

    /// Reads where the machine stands, and begins its thread. A drive in fault is an alarm.
    /// @param machine  must outlive it
    /// @param outputs  makes them; called again behind a reset that ended them
    ServedTarget(std::unique_ptr<RunTarget> target, const MachineDescription& machine, const Settings& settings,
                 MakeOutputs outputs);
    ~ServedTarget() override;

    /// What searches for references poll: RunOptions::interrupted.
    [[nodiscard]] static bool gives_up() noexcept { return gives_up_.load() || SignalWatch::interrupted(); }

    void advance(Time now) override;
    [[nodiscard]] bool has_room() const override { return feed_.room(); }
    [[nodiscard]] bool is_dry() const override;
    void submit(const FeedSegment& segment) override;
    void rest() override;
    [[nodiscard]] bool stands() const override;
    [[nodiscard]] std::vector<RunTarget::AxisPlace> places() const override;
    [[nodiscard]] std::string finish() override;

    MachineReading read() noexcept override;
    void obey(const ProgramEvent& event) noexcept override;
    [[nodiscard]] bool has_input(std::int32_t number) const noexcept override {
        return machine_->lines.input(number) != nullptr;
    }
    void forget_input() noexcept override;
    void watch_probe(bool away) noexcept override;
    void home(std::uint32_t axes) noexcept override;
    bool halt() noexcept override;
    void quick_stop() noexcept override;
    void enable(bool on) noexcept override;
    void reset_faults() noexcept override;

private:
    enum class Phase : std::uint8_t { closed, open, ready, failed };
    /// What the server's thread asks for; the other one does it, in this order.
    struct Orders {
        int stops = 0;               ///< as TargetFeed::look
        bool off = false;            ///< the drives
        bool opens = false;          ///< what is closed or has failed
        bool resets = false;         ///< faults of drives, too
        std::uint32_t home = 0;      ///< axes
        std::optional<bool> probe{}; ///< RunTarget::watch_probe()

        [[nodiscard]] bool any() const noexcept { return off || opens || home != 0; }
    };
    /// What the thread knows, for the server's.
    struct Known {
        PerAxis<double> mm{};
        std::uint32_t axes = 0; ///< by bits: those of which that is the machine's
        HomingPhase homing = HomingPhase::none;
        Alarm alarm = Alarm::none;
        std::string sentence{};
        double speed_mm_s = 0.0;
        RunTarget::Switches switches{};
    };

    void work() noexcept;
    void step();
    void announce();
    void look_at_switches();
    [[nodiscard]] Orders take_orders();
    void find_place();
    void begin_first();
    [[nodiscard]] hal::PortFailure make_ready(const FeedSegment& first);
    void end_motion(const MotionEnd& end);
    void drop_motion();
    void finish_motion();
    void fail(const std::string& sentence, Alarm alarm = Alarm::drive_fault);
    void fail_by(const std::string& sentence);
    bool look_where(bool at_once);
    void take_place(const FeedSegment& segment);
    [[nodiscard]] FeedSegment standing() const;
    [[nodiscard]] std::uint32_t all_axes() const noexcept {
        return (1U << static_cast<unsigned>(machine_->settings.axes)) - 1U;
    }
    [[nodiscard]] std::uint32_t known_axes() const;
    void close();
    void reopen();
    void recover(bool resets);
    void renew_outputs();
    void switch_off();
    void find_references(std::uint32_t axes);
    void leave();

    static std::atomic<bool> gives_up_;

    const MachineDescription* machine_;
    std::unique_ptr<RunTarget> target_;
    MakeOutputs make_outputs_;
    std::unique_ptr<ProgramOutputs> outputs_;
    hal::Clock* clock_;
    TargetFeed feed_;
    std::uint32_t segment_ticks_;
    // Of the server's thread:
    std::string sentence_;                // of the last reading
    std::deque<std::uint32_t> waypoints_; // of segments that are not executed
    bool rests_ = true;                   // rest() was called behind it
    std::uint64_t seen_ = 0;              // executed,
    Time moved_{};                        // when that changed
    bool stalls_ = true;                  // it has not for a while: the port waits for more, or has not begun
    // Shared:
    mutable std::mutex mutex_; // protects the members below
    Orders orders_;
    Known known_;
    std::uint64_t submitted_ = 0; // segments
    std::uint64_t finished_ = 0;  // of motions that are over
    bool busy_ = false;           // an order is carried out
    // Of the thread:
    Phase phase_ = Phase::closed;
    RunOptions options_{.stays = true};
    std::uint64_t looked_us_ = 0; // where it stands
    std::string unconfirmed_;     // at its end
    std::atomic<bool> leaves_{false};
    std::unique_ptr<hal::ClockThread> thread_;
};

} // namespace splinefeed::host
