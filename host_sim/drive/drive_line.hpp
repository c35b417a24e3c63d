// SPDX-License-Identifier: MIT
// DriveLine: where requests come from and replies go: TCP connections, several at once, or one serial line.
#pragma once

#include "host_sim/drive/drive_exchange.hpp"

#include <chrono>

namespace splinefeed::host {

class DriveLine {
public:
    struct Request {
        int channel = 0; ///< where its reply goes
        std::vector<std::uint8_t> bytes;
    };
    using Clock = std::chrono::steady_clock;

    /// Listens, or opens the serial line. Throws UsageError where that cannot be done.
    explicit DriveLine(const ListenAddress& address);
    DriveLine(const DriveLine&) = delete;
    DriveLine& operator=(const DriveLine&) = delete;
    ~DriveLine();

    /// The address with the port that was free.
    [[nodiscard]] const ListenAddress& address() const noexcept { return address_; }
    /// Until something arrives, a signal comes, or that time has passed; deaf: until the time has passed.
    void wait(std::chrono::microseconds longest, bool deaf);
    /// Whole, intact frames that have arrived, one of each connection at most. Never waits for TCP; on a serial line
    /// for the rest of a frame that has begun.
    [[nodiscard]] std::vector<Request> receive();
    /// A channel that is gone is none.
    void send(int channel, const std::vector<std::uint8_t>& bytes);
    /// Nobody reaches the drive until connect().
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
    void receive_serial(std::vector<Request>& requests);
    void close_connections();

    ListenAddress address_;
    ModbusContext context_;
    int listener_ = -1; // of TCP; of a serial line the line itself
    int channels_ = 0;
    bool readable_ = false; // the listener
    std::vector<Connection> connections_;
};

} // namespace splinefeed::host
