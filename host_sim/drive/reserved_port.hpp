// SPDX-License-Identifier: MIT
// ReservedPort: a TCP port that is kept while nobody listens there.
#pragma once

#include "host_sim/drive/listen_address.hpp"

namespace splinefeed::host {

/// No program that asks for any free port, for a listener or for the near end of a connection, gets this one, and
/// connections to it are refused until its owner listens there. It can listen there with SO_REUSEADDR, as libmodbus
/// does.
class ReservedPort {
public:
    ReservedPort() = default; ///< none
    /// Reserves address.port, and chooses one if that is 0. none() if that fails; errno says why.
    explicit ReservedPort(const ListenAddress& address);
    ReservedPort(const ReservedPort&) = delete;
    ReservedPort& operator=(const ReservedPort&) = delete;
    ~ReservedPort();

    [[nodiscard]] bool none() const noexcept { return socket_ < 0; }
    [[nodiscard]] int port() const noexcept { return port_; } ///< 0 where there is none

private:
    int socket_ = -1; // bound, and never listening
    int port_ = 0;
};

} // namespace splinefeed::host
