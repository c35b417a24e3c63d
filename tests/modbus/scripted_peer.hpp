// SPDX-License-Identifier: MIT
// ScriptedPeer: what answers a ModbusLink, byte by byte as a test wants it: on a TCP port of its own or a
// pseudo-terminal.
#pragma once

#include "splinefeed/hal/modbus/link/modbus_link.hpp"
#include "splinefeed/hal/rt/clock.hpp"

#include <arpa/inet.h>
#include <atomic>
#include <cstdlib>
#include <fcntl.h>
#include <functional>
#include <mutex>
#include <netinet/in.h>
#include <poll.h>
#include <stdexcept>
#include <sys/socket.h>
#include <termios.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace splinefeed_test {

using Bytes = std::vector<std::uint8_t>;

/// Of Modbus RTU, low byte first in the frame.
inline std::uint16_t crc16(const Bytes& bytes) {
    unsigned crc = 0xFFFF;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int i = 0; i < 8; ++i) {
            crc = (crc & 1U) != 0 ? crc >> 1U ^ 0xA001U : crc >> 1U;
        }
    }
    return static_cast<std::uint16_t>(crc);
}

inline Bytes with_crc(Bytes bytes) {
    const std::uint16_t crc = crc16(bytes);
    bytes.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
    bytes.push_back(static_cast<std::uint8_t>(crc >> 8U));
    return bytes;
}

/// A reply on TCP to this request: its transaction, then unit, function and data.
inline Bytes tcp_reply(const Bytes& request, const Bytes& body) {
    Bytes out{request[0], request[1], 0, 0, 0, static_cast<std::uint8_t>(body.size())};
    out.insert(out.end(), body.begin(), body.end());
    return out;
}

/// An answer of unit 1: the registers 0x1234 and 0x5678 at any address.
inline const Bytes two_registers{1, 3, 4, 0x12, 0x34, 0x56, 0x78};

/// Takes requests in a thread, one after the other (on a serial line those of eight bytes alone), and sends what the
/// script makes of each.
class ScriptedPeer {
public:
    /// An empty reply: none. What sleeps in it answers late. `hang_up` closes after what was sent; with `drip_us` the
    /// bytes come that far apart; `flood` sends them again and again until the other end closes.
    struct Reply {
        Bytes bytes;
        bool hang_up = false;
        unsigned drip_us = 0;
        bool flood = false;
    };
    using Script = std::function<Reply(const Bytes& request)>;
    /// On a serial line.
    static Reply rtu(const Bytes& bytes) { return {.bytes = with_crc(bytes)}; }
    enum class Wire { tcp, pty };

    ScriptedPeer(Wire wire, Script script) : script_(std::move(script)), serial_(wire == Wire::pty) {
        if (serial_) {
            open_pty();
        } else {
            open_tcp();
        }
        thread_ = std::thread([this] { serve(); });
    }
    ScriptedPeer(const ScriptedPeer&) = delete;
    ScriptedPeer& operator=(const ScriptedPeer&) = delete;
    ~ScriptedPeer() {
        stopping_ = true;
        thread_.join();
        hang_up();
        if (listener_ >= 0) {
            close(listener_);
        }
        if (slave_ >= 0) {
            close(slave_);
        }
    }

    /// Where it is reached; of a pseudo-terminal at 115200 baud.
    [[nodiscard]] const splinefeed::hal::modbus::LinkAddress& address() const { return address_; }
    /// When each request was complete, and when each reply began. [us of the monotonic clock]
    [[nodiscard]] std::vector<std::uint64_t> arrived_us() const { return copy(arrived_us_); }
    [[nodiscard]] std::vector<std::uint64_t> replied_us() const { return copy(replied_us_); }

private:
    void open_tcp() {
        listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        sockaddr_in any{};
        any.sin_family = AF_INET;
        any.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof(any);
        if (bind(listener_, reinterpret_cast<const sockaddr*>(&any), size) != 0 || listen(listener_, 4) != 0 ||
            getsockname(listener_, reinterpret_cast<sockaddr*>(&any), &size) != 0) {
            throw std::runtime_error("no port to listen on");
        }
        address_.port = ntohs(any.sin_port);
    }

    void open_pty() {
        line_ = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
        if (line_ < 0 || grantpt(line_) != 0 || unlockpt(line_) != 0) {
            throw std::runtime_error("no pseudo-terminal");
        }
        address_.wire = splinefeed::hal::modbus::Wire::rtu;
        address_.host = ptsname(line_);
        slave_ = open(address_.host.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC); // else the line hangs up between two
        termios raw{};
        tcgetattr(slave_, &raw);
        cfmakeraw(&raw);
        tcsetattr(slave_, TCSANOW, &raw);
    }

    [[nodiscard]] std::vector<std::uint64_t> copy(const std::vector<std::uint64_t>& times) const {
        const std::lock_guard lock(mutex_);
        return times;
    }

    void hang_up() {
        if (line_ >= 0) {
            close(line_);
            line_ = -1;
        }
    }

    void serve() {
        Bytes request;
        // On TCP a frame says how long it is; on the line there are reads alone.
        const auto whole = [&] {
            constexpr std::size_t header = 6;
            return serial_ ? 8 : request.size() < header ? header : header + (request[4] * 256U + request[5]);
        };
        while (!stopping_) {
            pollfd ready{line_ >= 0 ? line_ : listener_, POLLIN, 0};
            if (ready.fd < 0 || poll(&ready, 1, 5) != 1) {
                continue;
            }
            if (line_ < 0) {
                line_ = accept(listener_, nullptr, nullptr);
                request.clear();
                continue;
            }
            std::uint8_t byte = 0;
            if (read(line_, &byte, 1) != 1) {
                if (!serial_) {
                    hang_up();
                }
                continue;
            }
            request.push_back(byte);
            if (request.size() >= whole() && request.size() > 6) {
                answer(request);
                request.clear();
            }
        }
    }

    /// Returns whether the other end is still there.
    [[nodiscard]] bool put(const std::uint8_t* bytes, std::size_t size) const {
        const ssize_t done = serial_ ? write(line_, bytes, size) : send(line_, bytes, size, MSG_NOSIGNAL);
        return done == static_cast<ssize_t>(size);
    }

    void answer(const Bytes& request) {
        {
            const std::lock_guard lock(mutex_);
            arrived_us_.push_back(splinefeed::hal::system_clock().now_us());
        }
        const Reply reply = script_(request);
        {
            const std::lock_guard lock(mutex_);
            replied_us_.push_back(splinefeed::hal::system_clock().now_us());
        }
        bool open = true;
        const std::size_t step = reply.drip_us != 0 ? 1 : reply.bytes.size();
        for (std::size_t at = 0; open && at < reply.bytes.size(); at += step) {
            usleep(at == 0 ? 0 : reply.drip_us);
            open = put(&reply.bytes[at], step);
        }
        while (reply.flood && open && !stopping_) {
            const ssize_t size = send(line_, reply.bytes.data(), reply.bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
            open = size >= 0 || errno == EAGAIN;
        }
        if (reply.hang_up || !open) {
            hang_up();
        }
    }

    Script script_;
    bool serial_;
    splinefeed::hal::modbus::LinkAddress address_;
    int listener_ = -1;
    int line_ = -1; // the connection, or our end of the pseudo-terminal
    int slave_ = -1;
    std::atomic<bool> stopping_{false};
    mutable std::mutex mutex_;
    std::vector<std::uint64_t> arrived_us_;
    std::vector<std::uint64_t> replied_us_;
    std::thread thread_;
};

/// A link that is connected to a peer.
struct ScriptedLink {
    ScriptedLink(ScriptedPeer::Wire wire, const splinefeed::hal::modbus::LinkTiming& timing,
                 ScriptedPeer::Script script)
        : peer(wire, std::move(script)), link(peer.address(), timing) {
        if (!link.connect()) {
            throw std::runtime_error(link.error());
        }
    }
    ScriptedPeer peer;
    splinefeed::hal::modbus::ModbusLink link;
};

} // namespace splinefeed_test
