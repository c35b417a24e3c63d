// SPDX-License-Identifier: MIT
// VfdSpindle: a spindle behind a frequency inverter, in a thread of its own.
#pragma once

#include "splinefeed/hal/modbus/spindle/vfd_client.hpp"

#include <atomic>
#include <mutex>
#include <string>

namespace splinefeed::hal::modbus {

/// How the spindle is to turn.
struct SpindleOrder {
    int direction = 0; ///< 1 forward (M3), -1 reverse (M4), 0 stop
    double hz = 0.0;   ///< output frequency of the VFD
};

struct VfdSpindleSettings {
    std::uint32_t at_speed_timeout_ms = 10'000; ///< from an order to its speed
    std::uint32_t lost_ms = 1000;               ///< a VFD that has not answered for so long is lost
    std::uint32_t poll_ms = 50;                 ///< between two readings
};

/// Once the spindle has trouble, or end() was called, it gets stops until it confirms one, and it takes no order
/// any more. A spindle that was stopped never turns again. A spindle that has to stand and turns is told to stop again
/// with every reading. It is turned in the other direction only after it stood.
///
/// All functions but open() may be called by any thread at any time.
class VfdSpindle {
public:
    VfdSpindle(VfdWiring wiring, const VfdSpindleSettings& settings, const MakeWire& make = make_link,
               Clock& clock = system_clock());
    VfdSpindle(const VfdSpindle&) = delete;
    VfdSpindle& operator=(const VfdSpindle&) = delete;
    /// If the spindle was on: tells it to stop, for up to lost_ms.
    ~VfdSpindle();

    /// Stops the spindle, and starts the thread. Returns an empty text, or why the VFD cannot be used.
    [[nodiscard]] std::string open();
    /// The spindle gets the order as soon as the VFD answers. @pre the profile has the command
    void order(const SpindleOrder& order);
    /// Stops the spindle for good.
    void end();

    /// Whether the last order is carried out: the speed is reached, or the VFD has taken the stop. Never after end().
    [[nodiscard]] bool reached() const;
    /// Whether the VFD has confirmed a stop, and since then that its output is off.
    [[nodiscard]] bool stands() const;
    /// Whether it turned at open(), or was told to turn since then.
    [[nodiscard]] bool was_on() const;
    /// Why the spindle is not as ordered; empty: it is, or may still become so.
    [[nodiscard]] std::string trouble() const;
    /// Output frequency at its last answer. [Hz]
    [[nodiscard]] double output_hz() const;

private:
    [[nodiscard]] bool ended() const;
    [[nodiscard]] bool awaited() const;
    void work();
    void step();
    void carry_out(const SpindleOrder& order, bool fresh);
    [[nodiscard]] bool stop();
    void judge(const SpindleOrder& order, const VfdReading& reading);
    void fail(const std::string& what);
    /// Returns whether the exchange was good; else what follows from that.
    bool took(const LinkAnswer& answer, const char* what);

    VfdSpindleSettings settings_;
    Clock* clock_;
    VfdClient client_;

    mutable std::mutex mutex_; // protects the members up to the next comment
    SpindleOrder wanted_;
    std::uint64_t ordered_ = 0; // number of orders
    std::uint64_t carried_out_ = 0;
    bool ended_ = false;
    bool was_on_ = false;
    bool stands_ = false;
    double output_hz_ = 0.0;
    std::string trouble_;

    // Used by the thread:
    SpindleOrder told_;          // what the VFD has taken; its speed is below 0 if that is unknown
    bool known_ = false;         // told_ is what it has
    bool turns_ = true;          // by the last reading
    int turned_ = 0;             // the direction in which it was told to turn since it stood; 0: unknown
    std::uint64_t seen_ = 0;     // the order in work
    std::uint64_t began_us_ = 0; // when
    std::uint64_t answered_us_ = 0;
    int slow_ = 0; // readings in a row far below the speed

    std::atomic<bool> leaves_{false};
    std::unique_ptr<ClockThread> thread_;
};

} // namespace splinefeed::hal::modbus
