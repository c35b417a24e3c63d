// SPDX-License-Identifier: MIT
// ResourceClaim: what one program alone uses on this computer, and who does.
#pragma once

#include <string>

namespace splinefeed::host {

/// A socket without a file, whose name says what is claimed: it vanishes with the process, however that ends, and holds
/// for programs of all users. The same process may claim a resource twice.
class ResourceClaim {
public:
    /// @param resource  its name, "modbus-rtu:///dev/ttyUSB0"
    explicit ResourceClaim(const std::string& resource);
    ResourceClaim(const ResourceClaim&) = delete;
    ResourceClaim& operator=(const ResourceClaim&) = delete;
    ~ResourceClaim();

    /// The program that has it, "splinefeed serve (process 1234)"; empty: this one.
    [[nodiscard]] const std::string& holder() const noexcept { return holder_; }

private:
    int socket_;
    std::string holder_;
};

} // namespace splinefeed::host
