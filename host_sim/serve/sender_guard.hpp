// SPDX-License-Identifier: MIT
// SenderGuard: lets nothing of a connection through before its first line shows that it is a sender's.
#pragma once

#include "splinefeed/controller/realtime_byte.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace splinefeed::host {

/// Any page of the web can make a browser send bytes to a port of its own computer. They come behind an HTTP request, a
/// greeting of TLS, or the length of a STUN message. A sender's first byte may act at once, and its first line is text.
/// So nothing acts before the end of that, and a byte that no line has ends the connection.
class SenderGuard {
public:
    static constexpr std::size_t longest_line = 4096;

    /// What may go through of what has come. false: it is no sender; close the connection, but obey the stops of that.
    [[nodiscard]] bool take(std::string_view bytes, std::string& out);

private:
    std::string first_;
    bool passed_ = false;
};

/// Finds what stops the machine in the bytes of somebody who may do no more. A byte of a character in UTF-8 is text.
class StopBytes {
public:
    [[nodiscard]] std::vector<RealtimeByte> take(std::string_view bytes);

private:
    RealtimeBytes bytes_;
};

/// Whether a line is of HTTP.
[[nodiscard]] bool is_http(std::string_view line);

} // namespace splinefeed::host
