// SPDX-License-Identifier: MIT
// GpioPort: a machine on step and direction lines of GPIO chips: its motions, switches, references and stops.
#pragma once

#include "splinefeed/hal/gpio/gpio_phases.hpp"
#include "splinefeed/hal/gpio/port_mover.hpp"
#include "splinefeed/hal/gpio/switch_stops.hpp"

#include <functional>
#include <optional>

namespace splinefeed::hal::gpio {

/// Why a GpioPort does not go on. What is behind `touched` stays until open() ends it.
enum class GpioCause : std::uint8_t {
    none,
    asked,       ///< by halt()
    asked_twice, ///< by quick_stop()
    untouched,   ///< the motion is over, and the probe has touched nothing
    touched,     ///< it has
    limit,
    led_further, ///< into a limit that acts
    drive_fault,
    misplaced, ///< the motion begins elsewhere than where an axis stands
    e_stop,
    disabled, ///< by the port: a line that fails, inputs that are not read, a stall, a stop that did not end
};
struct GpioHold {
    GpioCause cause = GpioCause::none;
    std::string what{}; ///< a sentence without an end: "the limit of axis x (/dev/gpiochip0 X_LIMIT) acts"
};

/// Behind renew(), or prepare(), another motion follows, each from the count at which the one before has ended. What is
/// on stays on, and the switches act, until power_off() or leave(). One thread calls it.
class GpioPort final : public MotionPort {
public:
    using Noted = std::function<void(const InputChange& change, const std::optional<PerAxis<double>>& mm)>;

    /// Throws GpioError if inputs cannot be read. Map and lines must outlive it.
    /// @param noted  called by take_changes() for each change, with the place of the machine at its edge
    GpioPort(const PinMap& map, const GpioPortSettings& settings, MachinePins& lines, Noted noted);
    ~GpioPort();

    /// The drives were off, or are on and stand. What has stopped them stays until a reset; so does a limit on which a
    /// search was given up, which is a reset.
    [[nodiscard]] PortFailure open() override;
    [[nodiscard]] PortFailure prepare(const FeedSegment& first) override;
    [[nodiscard]] PortFailure renew(const FeedSegment& first) override;
    [[nodiscard]] int room() const noexcept override { return port_.room(); }
    [[nodiscard]] bool submit(const FeedSegment& segment) noexcept override;
    void complete() noexcept override;
    PortState poll() noexcept override;
    /// The plan is asked for a hold: hold(). If that does not come in time the port stops by itself.
    void halt() noexcept override { hold(GpioCause::asked, "interrupted"); }
    void quick_stop() noexcept override;
    void power_off() noexcept override { port_.power_off(); }
    /// Behind it the lines are safe, unless leave() has put the drives as they shall stay.
    void close() noexcept override;
    [[nodiscard]] PortFailure failure() const override { return {fault()}; }

    /// Why the plan has to be held on its path, and ends there.
    [[nodiscard]] const GpioHold& hold() const noexcept { return hold_; }
    /// What stops the machine now, whether it moves or not.
    [[nodiscard]] GpioHold stopped_by();
    /// Takes changes of switches; behind an alarm, too, where nobody polls: an axis that has stood for a while runs
    /// into nothing.
    void take_changes();
    /// From now on the next contact of the probe, or the loss of it, is noted with its place. One that is there
    /// already comes at once.
    void watch_probe(bool away);
    /// Where it came. [mm]
    [[nodiscard]] const std::optional<PerAxis<double>>& touched_mm() const noexcept { return touched_mm_; }
    /// Switches drives off that stand. Returns which may still be on.
    [[nodiscard]] std::string switch_off();
    /// The end: the drives are as the settings say. Returns which may still be on.
    [[nodiscard]] std::string leave();

    /// Whether lines were changed.
    [[nodiscard]] bool began() const noexcept { return phases_.phase() != GpioPhase::fresh; }
    /// CLOCK_MONOTONIC, of the begin of the first motion.
    [[nodiscard]] std::uint64_t began_ns() const noexcept { return began_ns_; }
    /// Whether steps and places agree: no drive was disabled in motion.
    [[nodiscard]] bool position_known() const noexcept { return port_.position_known(); }
    [[nodiscard]] const PortMover& places() const noexcept { return mover_; }
    [[nodiscard]] const SwitchInputs& inputs() const noexcept { return inputs_; }
    [[nodiscard]] const StepPort& steps() const noexcept { return port_; }

private:
    [[nodiscard]] PortFailure home(const FeedSegment& first);
    [[nodiscard]] bool align(const FeedSegment& first);
    void put(int axis, const FeedSegment& first) noexcept;
    void hold(GpioCause cause, const std::string& what);
    void hold_by(std::size_t input);
    void forget_stop() noexcept;
    void doubt_places() noexcept;
    void drop_changes();
    void touch(const std::optional<PerAxis<std::int64_t>>& counts);
    void follow_stop();
    void take(GpioEvent event) noexcept { phases_.take(event, time_->now_us()); }
    [[nodiscard]] bool lost() const noexcept { return port_.was_disabled() || !port_.position_known(); }
    [[nodiscard]] std::string fault() const;
    [[nodiscard]] std::string drives() const;
    [[nodiscard]] std::string still_on() const;
    [[nodiscard]] PerAxis<double> positions_at(const std::optional<PerAxis<std::int64_t>>& counts) const;

    const PinMap* map_;
    GpioPortSettings settings_;
    Clock* time_;
    MachinePins* lines_;
    Noted noted_;
    GpioPhases phases_{gpio_phase_table, GpioPhase::fresh};
    StepPort port_;
    SwitchInputs inputs_;
    PortMover mover_;
    SwitchStops stops_;
    std::optional<std::size_t> probe_; // its input
    StopSequence stop_;                // all axes stop as one drive
    std::uint64_t executed_us_ = 0;
    GpioHold hold_;
    PerAxis<std::int64_t> shift_{};  // of the motion's segments, to the count at which an axis stands [units]
    std::optional<bool> probe_away_; // a change of the probe is awaited: to no contact,
    std::optional<PerAxis<double>> touched_mm_; // or has come here
    std::uint64_t began_ns_;
};

} // namespace splinefeed::hal::gpio
