// SPDX-License-Identifier: MIT
// DriveWire: receives requests and sends replies: over several TCP connections at once, or over one serial line.
// ReservedPort: a TCP port that is kept while nobody listens there.
#pragma once

#include "host_sim/drive/drive_exchange.hpp"
#include "host_sim/drive/listen_address.hpp"

#include <chrono>

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

class DriveWire {
public:
    struct Request {
        int channel = 0; ///< the channel for its reply
        std::vector<std::uint8_t> bytes;
    };
    using Clock = std::chrono::steady_clock;

    /// Listens, or opens the serial line. Throws UsageError if that fails.
    explicit DriveWire(const ListenAddress& address);
    DriveWire(const DriveWire&) = delete;
    DriveWire& operator=(const DriveWire&) = delete;
    ~DriveWire();

    /// The address, with the port that was chosen.
    [[nodiscard]] const ListenAddress& address() const noexcept { return address_; }
    /// Waits until something arrives, a signal comes, or the time has passed. deaf: always until the time has passed.
    void wait(std::chrono::microseconds longest, bool deaf);
    /// Complete, undamaged frames that have arrived, at most one per connection. Never waits on TCP; on a serial line
    /// it waits for the rest of a frame that has begun.
    [[nodiscard]] std::vector<Request> receive();
    /// Does nothing if the channel no longer exists.
    void send(int channel, const std::vector<std::uint8_t>& bytes);
    /// To everybody who is connected.
    void send_all(const std::vector<std::uint8_t>& bytes);
    /// Closes all connections; until connect() nobody can reach the drive. Its port stays reserved.
    void disconnect();
    void connect();

private:
    struct Connection {
        int channel = 0;
        int descriptor = -1;
        bool closed = false;
        bool partial = false; // a frame has begun
        Clock::time_point began;
    };
    enum class Frame { none, partial, whole, closed };

    void listen();
    void accept_connections();
    [[nodiscard]] static Frame peek(const Connection& connection);
    void receive_from(Connection& connection, std::vector<Request>& requests);
    [[nodiscard]] bool is_ours(int unit) const noexcept;
    void receive_serial(std::vector<Request>& requests);
    void close_connections();

    ListenAddress address_;
    ModbusContext context_;
    ReservedPort reserved_; // TCP
    int listener_ = -1;     // the listening socket (TCP), or the serial line itself
    int channels_ = 0;
    bool readable_ = false; // of listener_
    std::vector<Connection> connections_;
};

} // namespace splinefeed::host
