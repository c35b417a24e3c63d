// SPDX-License-Identifier: MIT
// VfdClient: the exchanges with a frequency inverter (VFD), by its profile.
#pragma once

#include "splinefeed/hal/modbus/link/modbus_wire.hpp"
#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

#include <optional>
#include <vector>

namespace splinefeed::hal::modbus {

/// Where a VFD is and what it is.
struct VfdWiring {
    LinkAddress link;
    DriveProfile profile; ///< with StreamWay::speed
};

/// What a VFD says of itself.
struct VfdReading {
    double output_hz = 0.0;      ///< without sign
    bool done = true;            ///< by the profile's test; true without one
    bool fault = false;          ///< by the profile's states
    std::int64_t fault_code = 0; ///< the maker's; 0: unknown
};

/// For one thread. Each function repeats no exchange: what failed is tried again by the caller. A connection that was
/// lost is opened again by the next call.
class VfdClient {
public:
    VfdClient(VfdWiring wiring, const MakeWire& make, Clock& clock);

    /// Writes the speed, for the next run command or while it runs. [Hz]
    [[nodiscard]] LinkAnswer write_speed(double hz);
    /// forward, reverse or stop. @pre the profile has the command
    [[nodiscard]] LinkAnswer command(DriveCommand command);
    /// Reads output frequency, state and fault.
    [[nodiscard]] LinkAnswer read(VfdReading& out);
    /// Whether a reading would be sent at once: ModbusWire::read_from_us().
    [[nodiscard]] bool may_read() const;

    /// Speed that the register can hold, next to this one. [Hz]
    [[nodiscard]] double nearest_hz(double hz) const;
    [[nodiscard]] const DriveProfile& profile() const noexcept { return wiring_.profile; }
    /// Text for messages: what went wrong with an exchange.
    [[nodiscard]] std::string describe(const LinkAnswer& answer) const { return modbus::describe(answer, *link_); }

private:
    [[nodiscard]] bool connected();
    [[nodiscard]] LinkAnswer write_raw(FieldIndex index, std::int64_t raw);
    [[nodiscard]] LinkAnswer read_registers(const RegisterField& field, std::span<std::uint16_t> out);
    [[nodiscard]] LinkAnswer read_raw(FieldIndex index, std::int64_t& raw);
    [[nodiscard]] bool read_once(FieldIndex field, std::int64_t& raw, LinkAnswer& answer);

    VfdWiring wiring_;
    Clock* clock_;
    std::unique_ptr<ModbusWire> link_;
    std::vector<std::int64_t> written_;             // the last value of each field
    std::vector<std::optional<std::int64_t>> read_; // of the present reading
    FieldIndex speed_;
    FieldIndex output_;
};

} // namespace splinefeed::hal::modbus
