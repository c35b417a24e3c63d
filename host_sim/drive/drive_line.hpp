// SPDX-License-Identifier: MIT
// DriveLine: receives requests and sends replies: over several TCP connections at once, or over one serial line.
#pragma once

#include "host_sim/drive/drive_exchange.hpp"
#include "host_sim/drive/reserved_port.hpp"

#include <chrono>

namespace splinefeed::host {

class DriveLine {
public:
    struct Request {
        int channel = 0; ///< the channel for its reply
        std::vector<std::uint8_t> bytes;
    };
    using Clock = std::chrono::steady_clock;

    /// Listens, or opens the serial line. Throws UsageError if that fails.
    explicit DriveLine(const ListenAddress& address);
    DriveLine(const DriveLine&) = delete;
    DriveLine& operator=(const DriveLine&) = delete;
    ~DriveLine();

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
