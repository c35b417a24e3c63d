// SPDX-License-Identifier: MIT
// DriveExchange: applies a Modbus request to the drive model and returns libmodbus's reply to it, byte by byte.
#pragma once

#include "host_sim/drive/drive_model.hpp"
#include "host_sim/drive/listen_address.hpp"
#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

#include <memory>
#include <vector>

struct _modbus;
struct _modbus_mapping_t;

namespace splinefeed::host {

/// Owns a libmodbus context.
struct ModbusContextDeleter {
    void operator()(_modbus* context) const noexcept;
};
using ModbusContext = std::unique_ptr<_modbus, ModbusContextDeleter>;

/// Function codes 01 to 06, 16 and 23; exception 1 for any other. libmodbus makes the reply from a mapping that is kept
/// equal to the model. The reply passes through a pair of sockets, so that it can be delayed or damaged before it is
/// sent.
class DriveExchange {
public:
    /// Throws UsageError if libmodbus refuses the address.
    DriveExchange(DriveModel& model, const ListenAddress& address);
    DriveExchange(const DriveExchange&) = delete;
    DriveExchange& operator=(const DriveExchange&) = delete;
    ~DriveExchange();

    /// Applies the request. Returns its reply, or nothing if there must be none. The request is a complete, undamaged
    /// frame.
    [[nodiscard]] std::vector<std::uint8_t> answer(const std::vector<std::uint8_t>& request);
    /// Replies with an exception and changes nothing.
    [[nodiscard]] std::vector<std::uint8_t> refuse(const std::vector<std::uint8_t>& request, ModbusException exception);
    /// Number of bytes before the function code.
    [[nodiscard]] std::size_t header() const noexcept { return header_; }

private:
    [[nodiscard]] ModbusException take_effect(const std::vector<std::uint8_t>& request);
    [[nodiscard]] ModbusException read(int address, int count);
    [[nodiscard]] ModbusException read_table(hal::modbus::RegisterTable table, int address, int count);
    [[nodiscard]] ModbusException write_coil(int address, int value);
    [[nodiscard]] ModbusException write(int address, const std::uint8_t* bytes, int count);
    [[nodiscard]] std::vector<std::uint8_t> collect() const;
    void keep_mapping(std::vector<std::uint8_t>& request) const;

    DriveModel* model_;
    ModbusContext context_;
    _modbus_mapping_t* mapping_ = nullptr;
    std::size_t header_ = 0;
    bool serial_ = false;
    int near_ = -1; // libmodbus writes into this end
    int far_ = -1;
};

/// A context for the address. Throws UsageError if libmodbus refuses it.
[[nodiscard]] ModbusContext make_modbus_context(const ListenAddress& address);

} // namespace splinefeed::host
