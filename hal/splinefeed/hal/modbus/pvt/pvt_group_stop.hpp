// SPDX-License-Identifier: MIT
// PvtGroupStop: stops all drives of a ModbusPort by a StopSequence.
#pragma once

#include "splinefeed/hal/modbus/pvt/port_drive.hpp"
#include "splinefeed/hal/modbus/pvt/pvt_stop.hpp"

namespace splinefeed::hal::modbus {

/// Allocates in its constructor only.
class PvtGroupStop {
public:
    explicit PvtGroupStop(std::size_t drives) : facts_(drives), sequence_(drives, {}) { stops_.reserve(drives); }

    /// Adds the drives, each once, in order.
    void add(PvtClient& client, std::span<const PvtAxis> axes) { stops_.emplace_back(client, axes); }
    void set_times(const StopTimes& times, const PortTimes& port) noexcept {
        sequence_.set_times(times);
        times_ = port;
    }
    /// Before another motion. @pre the axes may move
    void reset() noexcept {
        sequence_.reset();
        for (PvtStop& stop : stops_) {
            stop.reset();
        }
    }
    void request(StopRequest request, std::uint64_t now_us) noexcept;
    /// Evaluates the drives' last reports and sends the required commands. Call periodically. Returns whether a drive
    /// got its next request, because its sequence escalated.
    bool update(std::uint64_t now_us, std::span<const PortDrive> drives) noexcept;
    [[nodiscard]] const StopSequence& sequence() const noexcept { return sequence_; }

private:
    [[nodiscard]] bool on_path(std::span<const PortDrive> drives) const noexcept;

    std::vector<PvtStop> stops_;
    std::vector<StopFacts> facts_;
    StopSequence sequence_;
    PortTimes times_;
    std::uint64_t hold_at_us_ = 0; // when a hold begins for all drives
    bool in_step_ = false;         // all drives were synchronous at the first request
    bool waits_ = false;           // nothing was sent yet
};

} // namespace splinefeed::hal::modbus
