// SPDX-License-Identifier: MIT
// WireClaims: drives, inverters and modules that this program alone uses.
#pragma once

#include "host_sim/base/resource_claim.hpp"
#include "host_sim/config/drive_address.hpp"
#include "host_sim/config/drive_table.hpp"

#include <list>

namespace splinefeed::host {

/// On a serial line nobody else may speak, so the line is claimed; on TCP the device at its address.
class WireClaims {
public:
    WireClaims() = default;
    /// Throws as add().
    explicit WireClaims(const DriveTable& table);
    explicit WireClaims(const DriveAddress& address) { add(address); }
    /// Throws TargetError, which names the program that has it.
    void add(const DriveAddress& address);

private:
    std::list<ResourceClaim> claims_;
};

} // namespace splinefeed::host
