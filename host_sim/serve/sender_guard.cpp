// SPDX-License-Identifier: MIT
#include "host_sim/serve/sender_guard.hpp"

#include <algorithm>
#include <cctype>

namespace splinefeed::host {

namespace {

bool acts(char c) {
    const RealtimeKind kind = realtime_byte(static_cast<std::uint8_t>(c)).kind;
    return kind != RealtimeKind::none && kind != RealtimeKind::nothing;
}

// TLS begins with 0x16, STUN by TCP with its length, below 0x0200; a terminal over a network with 0xff.
bool is_text(char c) {
    return (c >= ' ' && c <= '~') || c == '\t' || c == '\r' || c == '\n';
}

} // namespace

// A request line, whose method a page may choose, or the field that HTTP/1.1 demands.
bool is_http(std::string_view line) {
    const bool host = line.size() >= 5 && std::equal(line.begin(), line.begin() + 5, "host:", [](char a, char b) {
                          return std::tolower(static_cast<unsigned char>(a)) == b;
                      });
    return host || line.find(" HTTP/") != std::string_view::npos;
}

bool SenderGuard::take(std::string_view bytes, std::string& out) {
    for (const char c : bytes) {
        if (passed_ || (first_.empty() && acts(c))) {
            out += c;
            continue;
        }
        if (!(is_text(c) || acts(c)) || first_.size() == longest_line) {
            return false;
        }
        const bool ends = c == '\n' || c == '\r';
        if (ends && is_http(first_)) {
            return false;
        }
        passed_ = ends && !first_.empty();
        first_ += ends && !passed_ ? "" : std::string(1, c);
        if (passed_ || ends) {
            out += passed_ ? first_ : std::string(1, c);
        }
    }
    return true;
}

// Those act within a comment, too.
std::vector<RealtimeByte> StopBytes::take(std::string_view bytes) {
    std::vector<RealtimeByte> out;
    for (const char c : bytes) {
        const RealtimeByte byte = bytes_.take(static_cast<std::uint8_t>(c), true);
        if (byte.stops) {
            out.push_back(byte);
        }
    }
    return out;
}

} // namespace splinefeed::host
