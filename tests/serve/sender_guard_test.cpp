// SPDX-License-Identifier: MIT
#include "host_sim/serve/sender_guard.hpp"

#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

// What goes through, in parts of so many bytes; "closed" behind it where the connection ends.
std::string through(std::string_view bytes, std::size_t part) {
    SenderGuard guard;
    std::string out;
    for (std::size_t at = 0; at < bytes.size(); at += part) {
        if (!guard.take(bytes.substr(at, part), out)) {
            return out + "closed";
        }
    }
    return out;
}

} // namespace

TEST_CASE("Nothing of what is no sender goes through, however it is cut", "[serve]") {
    using namespace std::string_literals;
    const std::string orders = "\n$X\nG0X9\n~";
    const std::string long_line(1U << 20U, 'x');
    for (const std::string& begin : {
             "\x00\x0a\x00\x01\x00\x48\x21\x12\xa4\x42"s, // STUN by TCP: the length's second byte ends a line
             "\x00\x5c\x00\x01\n~\n"s,                    // the same, with another length
             "\x01\x0d\x00\x03\n"s,                       // TURN
             "\x16\x03\x01\x02\x00\x01\n"s,               // TLS
             "\x16\xfe\xfd\x00\x00\n"s,                   // DTLS
             "\xff\xfb\x1f\xff\xfb\x20"s,                 // telnet
             "G1X1(\xd1\x81)"s,                           // the byte in it would resume
             "POST /~! HTTP/1.1\r\nHost: a\r\n"s,
             "GET / HTTP/1.1\r\nUpgrade: websocket\r\n\r\n"s,
             "\r\nPRI * HTTP/2.0\r\n\r\nSM\r\n"s,
             "hOST: a"s,
             long_line,
         }) {
        for (const std::size_t part : {std::size_t{1}, std::size_t{7}, begin.size() + orders.size()}) {
            const std::string out = through(begin + orders, part);
            CHECK(out.find_first_not_of("\r\n") == out.find("closed"));
        }
    }
}

TEST_CASE("A sender's first byte acts at once, and its first line when it ends", "[serve]") {
    CHECK(through("?\x18!~\x85", 1) == "?\x18!~\x85");
    CHECK(through("\n?G1X1?", 1) == "\n?");
    CHECK(through("\n?G1X1?\n\x85\xc3\x84\x16", 1) == "\n?G1X1?\n\x85\xc3\x84\x16");
    const std::string longest(SenderGuard::longest_line - 1, 'x');
    CHECK(through(longest + "\n", 1000) == longest + "\n");
}

TEST_CASE("Who may only stop the machine does nothing else, and a letter stops nothing", "[serve]") {
    StopBytes stops;
    const auto kinds = [&](std::string_view bytes) {
        std::vector<RealtimeKind> out;
        for (const RealtimeByte byte : stops.take(bytes)) {
            out.push_back(byte.kind);
        }
        return out;
    };
    using enum RealtimeKind;
    CHECK(kinds("G1X9?~\x81\x90\xa0$X\n").empty());
    CHECK(kinds("!\x18\x19\x82\x84\x85") == std::vector{hold, reset, stop, hold, door, jog_cancel});
    CHECK(kinds("(\xd1\x84\xd1\x85 \xe2\x82\x84 \xf0\x9f\x84\x85)").empty());
    CHECK(kinds("\xd1").empty());
    CHECK(kinds("\x84").empty()); // the rest of it
    CHECK(kinds("\xd1\x84\x84") == std::vector{door});
    CHECK(kinds("\xc2\x85") == std::vector{jog_cancel}); // as senders write it that write UTF-8
}
