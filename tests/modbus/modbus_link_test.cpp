// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/link/connection_error.hpp"
#include "splinefeed/hal/modbus/link/modbus_link.hpp"

#include "scripted_peer.hpp"
#include "support/catch.hpp"

#include <modbus/modbus.h>

using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;

namespace {

constexpr LinkTiming patient{.answer_us = 1'000'000};
constexpr LinkTiming brief{.answer_us = 50'000};

/// A server made of libmodbus with 64 holding registers, 8 coils and 8 discrete inputs from address 0 on.
class Server {
public:
    Server() : context_(modbus_new_tcp("127.0.0.1", 0)), mapping_(modbus_mapping_new(8, 8, 64, 0)) {
        listener_ = modbus_tcp_listen(context_, 1);
        sockaddr_in bound{};
        socklen_t size = sizeof(bound);
        getsockname(listener_, reinterpret_cast<sockaddr*>(&bound), &size);
        port_ = ntohs(bound.sin_port);
        thread_ = std::thread([this] { serve(); });
    }
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;
    ~Server() {
        shutdown(listener_, SHUT_RDWR);
        thread_.join();
        modbus_mapping_free(mapping_);
        modbus_free(context_);
    }
    [[nodiscard]] LinkAddress address() const { return {.port = port_}; }
    /// Before the first request.
    void turn_on(int input) { mapping_->tab_input_bits[input] = 1; }

private:
    void serve() {
        int listener = listener_;
        while (modbus_tcp_accept(context_, &listener) >= 0) {
            std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> request{};
            for (int size = 0; (size = modbus_receive(context_, request.data())) != -1;) {
                modbus_reply(context_, request.data(), size, mapping_);
            }
            modbus_close(context_);
        }
        if (listener == listener_) { // else that version of libmodbus has closed it
            close(listener_);
        }
    }

    modbus_t* context_;
    modbus_mapping_t* mapping_;
    int listener_ = -1;
    int port_ = 0;
    std::thread thread_;
};

LinkFault fault_of(ScriptedPeer::Wire wire, const ScriptedPeer::Script& script, const LinkTiming& timing) {
    auto&& [peer, link] = ScriptedLink(wire, timing, script);
    std::array<std::uint16_t, 2> in{7, 8};
    const LinkAnswer answer = link.read(1, 0, in);
    CHECK(in == std::array<std::uint16_t, 2>{7, 8}); // a fault changes nothing
    CHECK(answer.answered_us >= answer.sent_us);
    CHECK(link.connected() == (answer.fault != LinkFault::disconnected));
    return answer.fault;
}

} // namespace

TEST_CASE("Link: functions 03, 16 and 23 against a server of libmodbus, and an exception with its code") {
    const Server server;
    ModbusLink link(server.address(), patient);
    REQUIRE(link.connect());
    CHECK(link.write(1, 3, std::array<std::uint16_t, 2>{0xBEEF, 7}).ok());
    std::array<std::uint16_t, 2> in{};
    const LinkAnswer read = link.read(1, 3, in);
    CHECK(read.ok());
    CHECK(in == std::array<std::uint16_t, 2>{0xBEEF, 7});
    CHECK(read.sent_us <= read.arrived_us);
    CHECK(read.replied_us <= read.answered_us);
    // The write comes first: what is read is what was written.
    CHECK(link.exchange(1, 10, std::array<std::uint16_t, 2>{5, 6}, 10, in).ok());
    CHECK(in == std::array<std::uint16_t, 2>{5, 6});
    const LinkAnswer beyond = link.read(1, 63, in);
    CHECK(beyond.fault == LinkFault::exception);
    CHECK(beyond.exception == 2);
    CHECK(std::string(exception_name(beyond.exception)) == "illegal address");
    CHECK(link.connected());
    CHECK(link.read(1, 0, in).ok());
}

TEST_CASE("Link: functions 01, 02 and 05 against a server of libmodbus") {
    Server server;
    server.turn_on(3);
    ModbusLink link(server.address(), patient);
    REQUIRE(link.connect());
    bool on = true;
    CHECK(link.read_bit(1, BitTable::coils, 5, on).ok());
    CHECK_FALSE(on);
    CHECK(link.write_coil(1, 5, true).ok());
    CHECK(link.read_bit(1, BitTable::coils, 5, on).ok());
    CHECK(on);
    CHECK(link.write_coil(1, 5, false).ok());
    CHECK(link.read_bit(1, BitTable::coils, 5, on).ok());
    CHECK_FALSE(on);
    CHECK(link.read_bit(1, BitTable::inputs, 3, on).ok());
    CHECK(on);
    CHECK(link.read_bit(1, BitTable::inputs, 8, on).exception == 2);
    CHECK(on); // a fault changes nothing
    CHECK(link.write_coil(1, 8, true).refused());
    CHECK(link.connected());
}

TEST_CASE("Link: on a serial line each fault has its name") {
    const auto on_line = [](const Bytes& reply, const LinkTiming& timing = patient) {
        return fault_of(
            ScriptedPeer::Wire::pty, [&](const Bytes&) { return ScriptedPeer::Reply{.bytes = reply}; }, timing);
    };
    CHECK(on_line({}, brief) == LinkFault::timeout);
    Bytes damaged = with_crc(two_registers);
    CHECK(on_line({damaged.begin(), damaged.begin() + 4}, brief) == LinkFault::timeout); // it broke off
    damaged.back() ^= 1U;
    CHECK(on_line(damaged) == LinkFault::corrupt);
    Bytes noisy = with_crc(two_registers);
    noisy[4] ^= 0x10U;
    CHECK(on_line(noisy) == LinkFault::corrupt);
    CHECK(on_line(with_crc({2, 3, 4, 0x12, 0x34, 0x56, 0x78})) == LinkFault::wrong_unit);
    CHECK(on_line(with_crc({1, 3, 2, 0x12, 0x34})) == LinkFault::wrong_length);
    CHECK(on_line(with_crc({1, 3, 6, 1, 2, 3, 4, 5, 6})) == LinkFault::wrong_length);
    CHECK(on_line(with_crc({1, 0x83, 4})) == LinkFault::exception);
}

TEST_CASE("Link: the code of an exception on a serial line") {
    for (const int code : {1, 2, 3, 4, 6, 11}) {
        auto&& [peer, link] = ScriptedLink(ScriptedPeer::Wire::pty, patient, [&](const Bytes&) {
            return ScriptedPeer::rtu({1, 0x83, static_cast<std::uint8_t>(code)});
        });
        std::array<std::uint16_t, 2> in{};
        const LinkAnswer answer = link.read(1, 0, in);
        CHECK(answer.fault == LinkFault::exception);
        CHECK(int{answer.exception} == code);
    }
}

TEST_CASE("Link: on TCP each fault has its name") {
    const auto on_tcp = [](const ScriptedPeer::Script& script, const LinkTiming& timing = patient) {
        return fault_of(ScriptedPeer::Wire::tcp, script, timing);
    };
    CHECK(on_tcp([](const Bytes&) { return ScriptedPeer::Reply{}; }, brief) == LinkFault::timeout);
    CHECK(on_tcp([](const Bytes&) { return ScriptedPeer::Reply{.bytes = {}, .hang_up = true}; }) ==
          LinkFault::disconnected);
    CHECK(on_tcp([](const Bytes& request) {
              return ScriptedPeer::Reply{tcp_reply(request, {1, 3, 2, 0x12, 0x34})};
          }) == LinkFault::wrong_length);
    CHECK(on_tcp([](const Bytes& request) {
              return ScriptedPeer::Reply{tcp_reply(request, {1, 0x83, 2})};
          }) == LinkFault::exception);
}

TEST_CASE("Link: nobody there, no such device, and nobody asked to connect") {
    const int bound = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in any{};
    any.sin_family = AF_INET;
    any.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(any);
    REQUIRE(bind(bound, reinterpret_cast<const sockaddr*>(&any), size) == 0);
    REQUIRE(getsockname(bound, reinterpret_cast<sockaddr*>(&any), &size) == 0);
    ModbusLink refused({.port = ntohs(any.sin_port)}, brief); // bound, but nobody listens
    CHECK_FALSE(refused.connect());
    CHECK(refused.error() == "Connection refused; check the port, and whether Modbus TCP is turned on in the drive");
    std::array<std::uint16_t, 1> in{};
    CHECK(refused.read(1, 0, in).fault == LinkFault::disconnected);
    close(bound);
    ModbusLink missing({.wire = Wire::rtu, .host = "/dev/no-such-line"}, brief);
    CHECK_FALSE(missing.connect());
    CHECK(missing.error().rfind("No such file or directory; is the adapter plugged in? this machine has ", 0) == 0);
    ModbusLink nameless({.host = std::string(70, 'x')}, brief); // longer than any name
    CHECK_FALSE(nameless.connect());
    CHECK(nameless.error() == "no host has the name " + std::string(70, 'x') + "; check it, or write an IPv4 address");
    CHECK(nameless.read(1, 0, in).fault == LinkFault::disconnected);
}

TEST_CASE("Link: each reason of the system has its own advice") {
    struct Row {
        int error;
        LinkAddress address;
        const char* sentence;
    };
    const LinkAddress serial{.wire = Wire::rtu, .host = "/dev/null"};
    for (const Row& row : {
             Row{ETIMEDOUT, {}, "Connection timed out; check address, power and cable"},
             Row{EHOSTUNREACH, {}, "No route to host; check the address, and this computer's network"},
             Row{ECONNRESET,
                 {},
                 "Connection reset by peer; the drive or another program has taken the connection; has "
                 "the drive only one?"},
             Row{EMFILE, {}, "Too many open files; check host, port and cable"},
             Row{EBUSY, serial, "Device or resource busy; another program uses the device; end it (fuser -v names it)"},
             Row{ENOTTY, serial,
                 "Inappropriate ioctl for device; that is no serial device; name one like /dev/ttyUSB0"},
             Row{EIO, serial, "Input/output error; the adapter was unplugged; plug it in, and begin again"},
             Row{EACCES, serial,
                 "Permission denied; only root may; run as root, or give it a group by a udev rule like "
                 "SUBSYSTEM==\"tty\", GROUP=\"dialout\", MODE=\"0660\""},
         }) {
        CHECK(connection_error(row.error, row.address) == row.sentence);
    }
}

TEST_CASE("Link: it goes on after a connection that broke") {
    std::atomic<int> requests{0};
    auto&& [peer, link] = ScriptedLink(ScriptedPeer::Wire::tcp, patient, [&](const Bytes& request) {
        return ++requests == 1 ? ScriptedPeer::Reply{.bytes = {}, .hang_up = true}
                               : ScriptedPeer::Reply{tcp_reply(request, two_registers)};
    });
    std::array<std::uint16_t, 2> in{};
    CHECK(link.read(1, 0, in).fault == LinkFault::disconnected);
    CHECK_FALSE(link.connected());
    REQUIRE(link.connect());
    CHECK(link.read(1, 0, in).ok());
    CHECK(in == std::array<std::uint16_t, 2>{0x1234, 0x5678});
}

TEST_CASE("Link: the silence between two frames of a serial line is kept") {
    for (const std::uint32_t before_us : {0U, 4000U}) {
        auto&& [peer, link] =
            ScriptedLink(ScriptedPeer::Wire::pty, {.answer_us = patient.answer_us, .before_us = before_us},
                         [](const Bytes&) { return ScriptedPeer::rtu(two_registers); });
        constexpr std::size_t exchanges = 10;
        std::uint64_t last_us = 0;
        for (std::size_t i = 0; i < exchanges; ++i) {
            std::array<std::uint16_t, 2> in{};
            const LinkAnswer answer = link.read(1, 0, in);
            REQUIRE(answer.ok());
            REQUIRE((i == 0 || answer.sent_us >= last_us + 1750 + before_us));
            // No estimate of the drive's clock may lie outside of the exchange.
            REQUIRE(answer.arrived_us >= answer.sent_us);
            REQUIRE(answer.replied_us <= answer.answered_us);
            last_us = answer.answered_us;
        }
        const auto arrived = peer.arrived_us();
        const auto replied = peer.replied_us();
        REQUIRE(arrived.size() == exchanges);
        for (std::size_t i = 1; i < exchanges; ++i) {
            CHECK(arrived[i] >= replied[i - 1] + 1750 + before_us);
        }
    }
}

TEST_CASE("Link: a serial line that failed three times in a row is left alone for 300 ms") {
    constexpr int silent = 3;
    std::atomic<int> requests{0};
    auto&& [peer, link] = ScriptedLink(ScriptedPeer::Wire::pty, {.answer_us = 200'000}, [&](const Bytes&) {
        return ++requests <= silent ? ScriptedPeer::Reply{} : ScriptedPeer::rtu(two_registers);
    });
    std::array<std::uint16_t, 2> in{};
    LinkAnswer failed;
    for (int i = 0; i < silent; ++i) {
        failed = link.read(1, 0, in);
        REQUIRE(failed.fault == LinkFault::timeout);
    }
    const LinkAnswer after = link.read(1, 0, in);
    CHECK(after.ok());
    CHECK(after.sent_us >= failed.answered_us + 300'000);
    const auto arrived = peer.arrived_us();
    REQUIRE(arrived.size() == silent + 1);
    CHECK(arrived.back() >= failed.answered_us + 300'000);
}

TEST_CASE("Link: every fault says what to look at") {
    for (const LinkFault fault : {LinkFault::none, LinkFault::timeout, LinkFault::disconnected, LinkFault::corrupt,
                                  LinkFault::wrong_unit, LinkFault::wrong_length, LinkFault::exception}) {
        CHECK(std::string(describe(fault)).size() >= 10);
    }
    CHECK(std::string(exception_name(6)) == "busy");
    CHECK(std::string(exception_name(200)) == exception_name(9));
}

TEST_CASE("Link: a unit number that no frame can carry is refused before anything is sent") {
    std::atomic<int> requests{0};
    auto&& [peer, link] = ScriptedLink(ScriptedPeer::Wire::tcp, patient, [&](const Bytes&) {
        ++requests;
        return ScriptedPeer::Reply{};
    });
    std::array<std::uint16_t, 2> in{7, 8};
    for (const int unit : {-1, 0, 248, 250, 254, 256}) {
        CHECK(link.read(unit, 0, in).fault == LinkFault::bad_unit);
        CHECK(link.write(unit, 0, in).fault == LinkFault::bad_unit);
    }
    CHECK(in == std::array<std::uint16_t, 2>{7, 8});
    CHECK(link.connected());
    CHECK(requests == 0);
    CHECK(is_unit(Wire::tcp, 255));
    CHECK_FALSE(is_unit(Wire::rtu, 255));
    CHECK(is_unit(Wire::rtu, 247));
}

TEST_CASE("Link: function 06 writes one register") {
    const Server server;
    ModbusLink link(server.address(), patient);
    REQUIRE(link.connect());
    CHECK(link.write_one(1, 5, 0xABCD).ok());
    std::array<std::uint16_t, 1> in{};
    REQUIRE(link.read(1, 5, in).ok());
    CHECK(in[0] == 0xABCD);
    CHECK(link.write_one(1, 64, 1).fault == LinkFault::exception);
}

TEST_CASE("Link: after one time-out more than its retries a tcp connection is given up, and a new one answers") {
    std::atomic<bool> silent{true};
    const auto script = [&](const Bytes& request) {
        return silent ? ScriptedPeer::Reply{} : ScriptedPeer::Reply{tcp_reply(request, two_registers)};
    };
    auto&& [peer, link] =
        ScriptedLink(ScriptedPeer::Wire::tcp, {.answer_us = 20'000, .before_us = 0, .retries = 2}, script);
    std::array<std::uint16_t, 2> in{};
    for (int i = 0; i < 3; ++i) {
        CHECK(link.connected());
        CHECK(link.read(1, 0, in).fault == LinkFault::timeout);
    }
    CHECK_FALSE(link.connected());
    CHECK(link.read(1, 0, in).fault == LinkFault::disconnected);
    silent = false;
    REQUIRE(link.connect());
    CHECK(link.read(1, 0, in).ok());
    CHECK(in == std::array<std::uint16_t, 2>{0x1234, 0x5678});
    // An answer in between starts the count anew.
    for (int i = 0; i < 6; ++i) {
        silent = i % 3 != 2;
        CHECK(link.read(1, 0, in).ok() == !silent);
    }
    CHECK(link.connected());
}

TEST_CASE("Link: a serial line is not opened anew for time-outs: it has no connection that could be lost") {
    auto&& [peer, link] = ScriptedLink(ScriptedPeer::Wire::pty, {.answer_us = 10'000, .before_us = 0, .retries = 0},
                                       [](const Bytes&) { return ScriptedPeer::Reply{}; });
    std::array<std::uint16_t, 2> in{};
    for (int i = 0; i < 3; ++i) {
        CHECK(link.read(1, 0, in).fault == LinkFault::timeout);
    }
    CHECK(link.connected());
}
