// SPDX-License-Identifier: MIT
// PvtStop: how a drive with the map splinefeed-pvt is stopped: which command in which state, and what is known of it.
#pragma once

#include "splinefeed/hal/modbus/pvt/port_times.hpp"
#include "splinefeed/hal/modbus/pvt/pvt_client.hpp"
#include "splinefeed/hal/standstill.hpp"
#include "splinefeed/hal/stop_sequence.hpp"

namespace splinefeed::hal::modbus {

class PvtStop {
public:
    /// How a feed hold took place.
    enum class Hold : std::uint8_t {
        none,    ///< it did not
        at_rest, ///< it stood, and its start was called off
        in_time, ///< it slowed down at full rate, from the instant that all were told
        apart,   ///< it slowed down, perhaps later than the others, or earlier, since its ring ended
    };

    explicit PvtStop(PvtClient& client) noexcept : client_(&client) {}

    /// What the drive said last. @pre not older than what was seen before
    void update(const DriveReport& report, const PortTimes& times) noexcept;
    /// Tells the drive, once, in place of whatever it is to be told; again where it refused.
    /// @param hold_at_us  when all drives begin to slow down, of our clock
    void send_once(StopRequest request, std::uint64_t hold_at_us) noexcept;
    [[nodiscard]] StopFacts facts() const noexcept;
    [[nodiscard]] Hold hold() const noexcept { return hold_; }

private:
    [[nodiscard]] PvtCommand command_for(StopRequest request) const noexcept;
    [[nodiscard]] Hold hold_by(const DriveReport& answer, const PortTimes& times) const noexcept;
    [[nodiscard]] bool powerless() const noexcept;
    [[nodiscard]] bool still() const noexcept;

    PvtClient* client_;
    DriveReport report_;
    PerAxis<Standstill> standstill_{};
    StopRequest pending_ = StopRequest::none; // and not answered yet
    PvtCommand command_ = PvtCommand::none;
    PvtState state_then_ = PvtState::disabled;
    std::uint64_t hold_at_us_ = 0;
    StopRequest executed_ = StopRequest::none;
    std::uint64_t executed_us_ = 0;
    Hold hold_ = Hold::none;
};

} // namespace splinefeed::hal::modbus
