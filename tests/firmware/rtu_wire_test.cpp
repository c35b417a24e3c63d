// SPDX-License-Identifier: MIT
#include "drive/rtu_wire.hpp"

#include "drive_bench.hpp"

#include <deque>
#include <support/catch.hpp>

using namespace firmware;

namespace {

constexpr RtuTiming timing{.silence = 36, .patience = 400};

/// A UART that has a byte in each tick, or a pause.
struct Wire {
    void put(const std::vector<std::uint8_t>& bytes) { in.insert(in.end(), bytes.begin(), bytes.end()); }
    void pause(int ticks) { in.insert(in.end(), static_cast<std::size_t>(ticks), Serial::nothing); }
    void run(int ticks) {
        for (int i = 0; i < ticks; ++i) {
            line.poll(
                [this] {
                    const int byte = in.empty() ? Serial::nothing : in.front();
                    if (!in.empty()) {
                        in.pop_front();
                    }
                    return byte;
                },
                [this](std::uint8_t byte) {
                    busy = !busy; // room in every other tick
                    if (!busy) {
                        out.push_back(byte);
                    }
                    return !busy;
                });
        }
    }
    void run_all() { run(static_cast<int>(in.size()) + 500); }

    RtuWire line{1, timing};
    std::deque<int> in;
    std::vector<std::uint8_t> out;
    bool busy = false;
};

} // namespace

TEST_CASE("RTU line: a request is there after the silence, not before", "[rtu]") {
    Wire wire;
    const std::vector<std::uint8_t> request = read_request(0, 1);
    wire.put(request);
    wire.run(static_cast<int>(request.size()) + 35);
    CHECK_FALSE(wire.line.asked());
    wire.run(1);
    REQUIRE(wire.line.asked());
    CHECK(std::equal(request.begin(), request.end(), wire.line.request().begin(), wire.line.request().end()));
}

TEST_CASE("RTU line: the answer goes out once, and what comes meanwhile is dropped", "[rtu]") {
    Wire wire;
    wire.put(read_request(0, 1));
    wire.run_all();
    REQUIRE(wire.line.asked());
    wire.put({9, 9, 9});
    wire.run(3);
    for (std::uint8_t i = 0; i < 20; ++i) {
        wire.line.reply()[i] = i;
    }
    wire.line.answer(20);
    wire.put(std::vector<std::uint8_t>(20, 5)); // the echo
    wire.run(100);
    REQUIRE(wire.out.size() == 20);
    CHECK(wire.out[19] == 19);
    CHECK_FALSE(wire.line.asked());
    wire.put(read_request(0, 2));
    wire.run_all();
    CHECK(wire.line.asked());
}

TEST_CASE("RTU line: no answer, and it listens again", "[rtu]") {
    Wire wire;
    wire.put(read_request(0, 1));
    wire.run_all();
    wire.line.answer(0);
    CHECK_FALSE(wire.line.asked());
    wire.put(read_request(0, 1));
    wire.run_all();
    CHECK(wire.line.asked());
    CHECK(wire.out.empty());
}

TEST_CASE("RTU line: a gap in a request to this unit", "[rtu]") {
    Wire wire;
    const std::vector<std::uint8_t> request = read_request(0, 1);
    wire.put({request.begin(), request.begin() + 3});
    wire.pause(300); // less than its patience
    wire.put({request.begin() + 3, request.end()});
    wire.run_all();
    REQUIRE(wire.line.asked());
    CHECK(wire.line.request().size() == request.size());
}

TEST_CASE("RTU line: a request without its end is forgotten", "[rtu]") {
    Wire wire;
    wire.put({1, 3, 0});
    wire.pause(400);
    wire.put(read_request(0, 1));
    wire.run_all();
    REQUIRE(wire.line.asked());
    CHECK(wire.line.request().size() == 8);
}

TEST_CASE("RTU line: frames of others end with a silence", "[rtu]") {
    Wire wire;
    wire.put({2, 3, 200, 1, 2, 3}); // another slave's answer looks like a long request
    wire.pause(36);
    wire.put(read_request(0, 1));
    wire.run_all();
    CHECK(wire.line.asked());
}

TEST_CASE("RTU line: lost bytes, noise before a frame, and a frame that is too long", "[rtu]") {
    for (const int kind : {0, 1, 2}) {
        Wire wire;
        if (kind == 0) {
            wire.put({1, 3, 0});
            wire.in.push_back(Serial::lost);
            wire.put({0, 1, 0x84, 0x0A});
        } else if (kind == 1) {
            wire.put({0xFF});
            wire.put(read_request(0, 1));
        } else {
            wire.put(std::vector<std::uint8_t>(300, 1));
        }
        wire.pause(36);
        wire.run(static_cast<int>(wire.in.size()) + 2);
        CHECK_FALSE(wire.line.asked());
        wire.put(read_request(0, 1));
        wire.run_all();
        CHECK(wire.line.asked());
    }
}
