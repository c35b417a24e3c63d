// SPDX-License-Identifier: MIT
// How long an exchange may take whatever comes in, and whose answer it gets.
#include "splinefeed/hal/modbus/link/modbus_link.hpp"

#include "scripted_peer.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <random>

using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;

namespace {

constexpr LinkTiming brief{.answer_us = 50'000};
constexpr unsigned us_per_ms = 1000;

Bytes cut(Bytes bytes, std::size_t size) {
    bytes.resize(size);
    return bytes;
}

} // namespace

TEST_CASE("Link: an exchange has a bound, whatever trickles in") {
    constexpr std::uint64_t most_us = 400'000; // a busy host; libmodbus waited 500 ms for each byte
    for (const auto wire : {ScriptedPeer::Wire::pty, ScriptedPeer::Wire::tcp}) {
        for (const bool drips : {false, true}) {
            const bool serial = wire == ScriptedPeer::Wire::pty;
            CAPTURE(serial, drips);
            auto&& [peer, link] = ScriptedLink(wire, brief, [&](const Bytes& request) {
                const Bytes whole = serial ? with_crc(two_registers) : tcp_reply(request, two_registers);
                return ScriptedPeer::Reply{.bytes = drips ? whole : cut(whole, whole.size() - 1),
                                           .drip_us = drips ? 100 * us_per_ms : 0};
            });
            std::array<std::uint16_t, 2> in{7, 8};
            const LinkAnswer answer = link.read(1, 0, in);
            CHECK(answer.fault == LinkFault::timeout);
            CHECK(answer.answered_us - answer.sent_us < most_us);
            CHECK(in == std::array<std::uint16_t, 2>{7, 8});
        }
    }
}

TEST_CASE("Link: a connection that is flooded is closed within two exchanges, and a new one answers") {
    std::atomic<bool> floods{true};
    auto&& [peer, link] = ScriptedLink(ScriptedPeer::Wire::tcp, brief, [&](const Bytes& request) {
        return floods ? ScriptedPeer::Reply{.bytes = Bytes(4096, 0x55), .flood = true}
                      : ScriptedPeer::Reply{.bytes = tcp_reply(request, two_registers)};
    });
    std::array<std::uint16_t, 2> in{};
    const std::uint64_t most_us = longest_exchange_us(link.address(), brief, 0, 2);
    for (int i = 0; i < 2; ++i) {
        const std::uint64_t began_us = link.clock().now_us();
        CHECK_FALSE(link.read(1, 0, in).ok());
        CHECK(link.clock().now_us() - began_us < most_us);
    }
    CHECK_FALSE(link.connected());
    floods = false;
    REQUIRE(link.connect());
    CHECK(link.read(1, 0, in).ok());
    CHECK(in == std::array<std::uint16_t, 2>{0x1234, 0x5678});
}

TEST_CASE("Link: a late answer is not taken for that of the next request") {
    // The first answer comes 100 ms late, with another value; the link waits 50 ms.
    for (const unsigned pause_ms : {0U, 150U}) {
        CAPTURE(pause_ms);
        std::atomic<int> requests{0};
        auto&& [peer, link] = ScriptedLink(ScriptedPeer::Wire::tcp, brief, [&](const Bytes& request) {
            const bool first = ++requests == 1;
            if (first) {
                usleep(100 * us_per_ms);
            }
            return ScriptedPeer::Reply{tcp_reply(request, first ? Bytes{1, 3, 4, 9, 9, 9, 9} : two_registers)};
        });
        std::array<std::uint16_t, 2> in{};
        CHECK(link.read(1, 0, in).fault == LinkFault::timeout);
        usleep(pause_ms * us_per_ms);
        // It may be in the way for once or twice, by name; it is never taken.
        LinkAnswer answer;
        for (int i = 0; i == 0 || (i < 20 && !answer.ok()); ++i) {
            answer = link.read(1, 0, in);
            CHECK((answer.ok() || answer.fault == LinkFault::timeout || answer.fault == LinkFault::wrong_length));
            CHECK(in[0] != 0x0909);
        }
        REQUIRE(answer.ok());
        CHECK(in == std::array<std::uint16_t, 2>{0x1234, 0x5678});
    }
}

TEST_CASE("Link: a serial line that is an answer behind is brought back") {
    // Each answer says to which request it belongs; the first comes 100 ms late, when the second is waited for,
    // the others after 20 ms.
    std::atomic<int> requests{0};
    auto&& [peer, link] = ScriptedLink(ScriptedPeer::Wire::pty, brief, [&](const Bytes&) {
        const int number = ++requests;
        usleep((number == 1 ? 100 : 20) * us_per_ms);
        return ScriptedPeer::rtu({1, 3, 4, 0, static_cast<std::uint8_t>(number), 0, 0});
    });
    std::array<std::uint16_t, 2> in{};
    CHECK(link.read(1, 0, in).fault == LinkFault::timeout);
    for (int asked = 2; asked < 20; ++asked) {
        if (link.read(1, 0, in).ok() && int{in[0]} == asked) {
            SUCCEED("in step again");
            return;
        }
        link.resynchronise();
    }
    FAIL("it stays behind");
}

TEST_CASE("Link: on a serial line no reading gets the answer of an earlier one, up to 250 ms after the time-out") {
    constexpr int readings = 30;
    const unsigned seed = splinefeed_test::random_seed();
    CAPTURE(seed);
    std::minstd_rand random(seed);
    std::atomic<int> asked{0};
    std::atomic<std::uint64_t> sent_us{0}; // the request, or somewhat later than this
    std::atomic<bool> too_late{false};     // this host is so busy that the peer was
    auto&& [peer, link] = ScriptedLink(ScriptedPeer::Wire::pty, brief, [&](const Bytes&) {
        const auto number = static_cast<std::uint8_t>(++asked);
        if (random() % 3 == 0) {
            usleep((50U + 1U + static_cast<unsigned>(random() % 250)) * us_per_ms);
        }
        too_late = too_late || splinefeed::hal::system_clock().now_us() > sent_us + 345 * us_per_ms;
        return ScriptedPeer::Reply{.bytes = with_crc({1, 3, 4, 0, number, 0, 0})};
    });
    int good = 0;
    for (int i = 0; i < readings && !too_late; ++i) {
        std::array<std::uint16_t, 2> in{};
        sent_us = std::max(link.clock().now_us(), link.read_from_us(1));
        if (link.read(1, 0, in).ok() && !too_late) {
            REQUIRE(int{in[0]} == asked);
            ++good;
        }
    }
    CHECK((too_late || good >= readings / 3));
}

TEST_CASE("Link: on a serial line a late confirmation is not that of another writing of its kind") {
    // The first is confirmed 100 ms late, the second never comes to the drive.
    std::atomic<int> requests{0};
    auto&& [peer, link] = ScriptedLink(ScriptedPeer::Wire::pty, brief, [&](const Bytes& request) {
        const int number = ++requests;
        usleep(number == 1 ? 100 * us_per_ms : 0);
        return number == 2 ? ScriptedPeer::Reply{} : ScriptedPeer::Reply{.bytes = request};
    });
    CHECK(link.write_one(1, 7, 5).fault == LinkFault::timeout);
    CHECK(link.owes_answer(1));
    CHECK_FALSE(link.owes_answer(2));
    CHECK_FALSE(link.write_one(1, 7, 6).ok());
    CHECK(link.write_one(1, 7, 6).ok()); // the same again
}

TEST_CASE("Link: a unit owes no answer to a reading any more once it has answered a writing that came later") {
    std::atomic<int> requests{0};
    auto&& [peer, link] = ScriptedLink(ScriptedPeer::Wire::pty, brief, [&](const Bytes& request) {
        return ++requests == 1 ? ScriptedPeer::Reply{} : ScriptedPeer::Reply{.bytes = request};
    });
    std::array<std::uint16_t, 2> in{};
    const LinkAnswer missed = link.read(1, 0, in);
    CHECK(missed.fault == LinkFault::timeout);
    CHECK(link.read_from_us(1) >= missed.answered_us + OpenAnswers::latest_us);
    CHECK(link.read_from_us(2) == 0);
    CHECK(link.write_one(1, 7, 5).ok());
    CHECK(link.read_from_us(1) == 0);
    CHECK_FALSE(link.owes_answer(1));
}

TEST_CASE("Open answers: which request has to wait, and until when") {
    OpenAnswers open;
    constexpr std::uint64_t until_us = 1000 + OpenAnswers::latest_us;
    for (const RequestKind kind : {RequestKind::reading, RequestKind::single_write, RequestKind::write}) {
        open = {};
        open.missed(3, kind, 77, 1000);
        for (const RequestKind next : {RequestKind::reading, RequestKind::single_write, RequestKind::write}) {
            CHECK(open.until_us(3, next, 78) == (next == kind ? until_us : 0));
            CHECK(open.until_us(4, next, 78) == 0);
        }
        CHECK(open.until_us(3, kind, 77) == (kind == RequestKind::reading ? until_us : 0)); // the same writing again
        CHECK(open.owes(3, until_us - 1));
        CHECK_FALSE(open.owes(3, until_us));
        open.answered(3, kind); // it may have been the earlier one
        CHECK(open.until_us(3, kind, 78) == until_us);
        open.answered(3, RequestKind::exchange);
        CHECK(open.until_us(3, kind, 78) == 0);
    }
    open.missed(3, RequestKind::exchange, 0, 1000); // has a number of its own
    CHECK(open.until_us(3, RequestKind::exchange, 0) == 0);
    CHECK_FALSE(open.owes(3, 1000));
}
