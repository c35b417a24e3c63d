// SPDX-License-Identifier: MIT
// SenderDoor: where senders connect: a TCP port of this computer, and a pseudo terminal.
#pragma once

#include "splinefeed/controller/realtime_byte.hpp"

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace splinefeed::host {

/// Whether this build has sockets.
[[nodiscard]] bool has_sender_door() noexcept;

/// One sender at a time has the machine. Another one is told so, and all that it may do is to stop the machine. It has
/// to connect anew, when the first one has gone, or was silent for 3 s and nothing moves. A sender whose computer or
/// link does not answer for 3 s has gone. All that comes is read at once, so a stop never waits behind lines. A sender
/// that does not read loses reports, and with 64 KiB unread the machine. For one thread, which never waits here but in
/// wait().
class SenderDoor {
public:
    struct Events {
        std::function<void(const std::string& name)> opened; ///< it has the machine
        std::function<void(std::string_view bytes)> received;
        std::function<void(RealtimeByte stop)> stopped;     ///< by anybody, for the machine at once
        std::function<void()> closed;                       ///< it has gone
        std::function<bool()> rests;                        ///< whether another one may take the machine
        std::function<void(const std::string& text)> noted; ///< for the log: who was sent away, and why
    };

    virtual ~SenderDoor() = default;
    SenderDoor(const SenderDoor&) = delete;
    SenderDoor& operator=(const SenderDoor&) = delete;

    /// Listens at ADDRESS:PORT of this computer; port 0: any that is free. Returns the address. Throws UsageError.
    virtual std::string listen(const std::string& address) = 0;
    /// Makes a pseudo terminal, for its owner alone, and a symbolic link to it. Returns its name. Throws UsageError.
    virtual std::string open_terminal(const std::string& link) = 0;
    /// The operator's own terminal: `line` gets its lines.
    virtual void watch_input(std::function<void(std::string_view line)> line) = 0;
    /// Waits for what comes, and passes it on.
    virtual void wait(std::chrono::microseconds longest) = 0;
    /// To the sender that has the machine: whole lines.
    virtual void send(std::string_view text) = 0;
    [[nodiscard]] virtual bool has_sender() const noexcept = 0;

protected:
    SenderDoor() = default;
};

/// @pre has_sender_door()
[[nodiscard]] std::unique_ptr<SenderDoor> make_sender_door(const SenderDoor::Events& events);

} // namespace splinefeed::host
