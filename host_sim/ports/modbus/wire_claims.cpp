// SPDX-License-Identifier: MIT
#include "host_sim/ports/modbus/wire_claims.hpp"

#include "host_sim/ports/run_target.hpp"

#include <filesystem>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

// A device has several names: links below /dev/serial, and localhost.
std::string resource_of(const hal::modbus::LinkAddress& link) {
    if (link.wire == hal::modbus::Wire::rtu) {
        std::error_code none;
        const std::filesystem::path device = std::filesystem::canonical(link.host, none);
        return "modbus-rtu://" + (none ? link.host : device.string());
    }
    return fmt::format("modbus-tcp://{}:{}/{}", link.host == "localhost" ? "127.0.0.1" : link.host, link.port,
                       link.unit);
}

} // namespace

WireClaims::WireClaims(const DriveTable& table) {
    for (const DriveTable::Drive& drive : table.drives) {
        add(drive.address);
    }
}

void WireClaims::add(const DriveAddress& address) {
    const ResourceClaim& claim = claims_.emplace_back(resource_of(address.link));
    if (!claim.holder().empty()) {
        throw TargetError("{}: {} uses it; end that first", address.text, claim.holder());
    }
}

} // namespace splinefeed::host
