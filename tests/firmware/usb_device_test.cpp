// SPDX-License-Identifier: MIT
#include "usb_host.hpp"

#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <map>
#include <string>

namespace {

struct Bench {
    explicit Bench(std::uint64_t seed = 1) : random(seed) { serial.start(); }
    ~Bench() { CHECK(controller.misuse.empty()); }
    Bench(const Bench&) = delete;
    Bench& operator=(const Bench&) = delete;

    std::mt19937_64 random;
    UsbController controller{};
    rp2040::UsbSerial serial{controller};
    UsbHost host{controller, serial, random};
};

constexpr std::uint16_t status_of_device = 0x8000;
constexpr std::uint16_t status_of_interface = 0x8100;
constexpr std::uint16_t status_of_endpoint = 0x8200;
constexpr std::uint16_t clear_halt = 0x0201;
constexpr std::uint16_t set_halt = 0x0203;
constexpr std::uint16_t get_descriptor = 0x8006;
constexpr std::uint16_t get_configuration = 0x8008;
constexpr std::uint16_t set_configuration = 0x0009;

/// What a reader of its own finds in a configuration descriptor.
struct Reading {
    unsigned total = 0;
    std::map<unsigned, Bytes> interfaces{};                     // number: count of endpoints, class, subclass, protocol
    std::map<unsigned, std::pair<unsigned, Bytes>> endpoints{}; // address: interface; kind, size
    Bytes association{};                                        // first, count, class, subclass
    Bytes functional{};                                         // subtypes
    Bytes joined{};                                             // of the union
    bool whole = false;
};

Reading read_configuration(const Bytes& bytes) {
    Reading out;
    std::size_t at = 0;
    unsigned interface = 99;
    while (at + 2 <= bytes.size() && bytes[at] >= 2 && at + bytes[at] <= bytes.size()) {
        const Bytes one(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                        bytes.begin() + static_cast<std::ptrdiff_t>(at + bytes[at]));
        switch (one[1]) {
        case 2: out.total = one.at(2) + 256U * one.at(3); break;
        case 4:
            interface = one.at(2);
            out.interfaces[interface] = {one.at(4), one.at(5), one.at(6), one.at(7)};
            break;
        case 5: out.endpoints[one.at(2)] = {interface, {one.at(3), one.at(4), one.at(5)}}; break;
        case 11: out.association = {one.at(2), one.at(3), one.at(4), one.at(5)}; break;
        case 0x24:
            out.functional.push_back(one.at(2));
            if (one.at(2) == 6) {
                out.joined = {one.at(3), one.at(4)};
            }
            break;
        default: FAIL("a descriptor of kind " << int{one[1]});
        }
        at += one.size();
    }
    out.whole = at == bytes.size();
    return out;
}

std::string text_of(const Bytes& descriptor) {
    std::string out;
    REQUIRE(descriptor.size() >= 2);
    REQUIRE(descriptor[0] == descriptor.size());
    REQUIRE(descriptor[1] == 3);
    for (std::size_t i = 2; i < descriptor.size(); i += 2) {
        REQUIRE(descriptor[i + 1] == 0);
        out += static_cast<char>(descriptor[i]);
    }
    return out;
}

} // namespace

TEST_CASE("USB: the descriptors are a serial port's, for a reader of its own", "[usb]") {
    Bench bench;
    UsbHost& host = bench.host;
    REQUIRE(bench.controller.is_attached());
    host.reset();
    Bytes none;
    bool data1 = false;
    for (unsigned endpoint = 1; endpoint < 16; ++endpoint) { // whatever the memory had
        CHECK(bench.controller.in(0, endpoint, none, data1) == Handshake::none);
        CHECK(bench.controller.out(0, endpoint, {}, false) == Handshake::none);
    }
    const Bytes device = host.control(get_descriptor, 0x0100, 0, 64).value();
    REQUIRE(device.size() == 18);
    CHECK(device[0] == 18);
    CHECK(device[7] == 64);
    CHECK(Bytes(device.begin() + 4, device.begin() + 7) == Bytes{0xef, 2, 1}); // associated interfaces
    CHECK(Bytes(device.begin() + 8, device.begin() + 12) == Bytes{0x8a, 0x2e, 0x0a, 0x00});
    CHECK(device[17] == 1);
    CHECK(host.control(get_descriptor, 0x0100, 0, 8).value() == Bytes(device.begin(), device.begin() + 8));
    REQUIRE(host.enumerate());
    CHECK(host.control(get_descriptor, 0x0200, 0, 9).value().size() == 9);
    const Bytes configuration = host.control(get_descriptor, 0x0200, 0, 255).value();
    const Reading read = read_configuration(configuration);
    CHECK(read.whole);
    CHECK(read.total == configuration.size());
    CHECK(configuration[4] == read.interfaces.size());
    CHECK(read.association == Bytes{0, 2, 2, 2});
    CHECK(read.interfaces == std::map<unsigned, Bytes>{{0, {1, 2, 2, 0}}, {1, {2, 10, 0, 0}}});
    CHECK(read.functional == Bytes{0, 1, 2, 6});
    CHECK(read.joined == Bytes{0, 1});
    REQUIRE(read.endpoints.size() == 3);
    CHECK(read.endpoints.at(0x81) == std::pair<unsigned, Bytes>{0, {3, 16, 0}});
    CHECK(read.endpoints.at(0x02) == std::pair<unsigned, Bytes>{1, {2, 64, 0}});
    CHECK(read.endpoints.at(0x82) == std::pair<unsigned, Bytes>{1, {2, 64, 0}});
    CHECK(host.control(get_descriptor, 0x0300, 0, 255).value() == Bytes{4, 3, 9, 4});
    CHECK(text_of(host.control(get_descriptor, 0x0300 + device[14], 0x0409, 255).value()) == "splinefeed");
    CHECK(text_of(host.control(get_descriptor, 0x0300 + device[15], 0x0409, 255).value()) ==
          "splinefeed motion control board"); // 64 bytes
    CHECK(!text_of(host.control(get_descriptor, 0x0300 + device[16], 0x0409, 255).value()).empty());
    for (const unsigned name : {0x0304U, 0x0600U, 0x0700U, 0x0201U, 0x2200U, 0x0f00U}) { // 0600: of high speed
        CAPTURE(name);
        CHECK(host.is_refused(get_descriptor, static_cast<std::uint16_t>(name), 0, 255));
    }
}

TEST_CASE("USB: an answer is as long as the host asked, and one of whole packets ends", "[usb]") {
    Bench bench;
    REQUIRE(bench.host.enumerate());
    const Bytes all = bench.host.control(get_descriptor, 0x0200, 0, 500).value();
    for (std::uint16_t length = 0; length < 100; ++length) {
        CAPTURE(length);
        const auto got = bench.host.control(get_descriptor, 0x0200, 0, length);
        REQUIRE(got);
        CHECK(*got == Bytes(all.begin(), all.begin() + std::min<std::ptrdiff_t>(length, std::ssize(all))));
    }
}

TEST_CASE("USB: a host may end an answer early", "[usb]") {
    Bench bench;
    UsbHost& host = bench.host;
    REQUIRE(host.enumerate());
    for (int i = 0; i < 4; ++i) {
        Bytes packet;
        REQUIRE(host.setup(get_descriptor, 0x0200, 0, 75));
        host.turn();
        if (i > 1) {
            REQUIRE(host.poll_in(0, packet, true));
            host.turn();
        }
        REQUIRE(host.poll_out(0, {}, true));
        host.turn();
        bool data1 = false;
        CHECK(bench.controller.in(host.address, 0, packet, data1) == Handshake::nak);
        CHECK(host.control(status_of_device, 0, 0, 2) == Bytes{0, 0});
    }
}

TEST_CASE("USB: each standard request of chapter 9, and what is none", "[usb]") {
    Bench bench;
    UsbHost& host = bench.host;
    host.reset();
    CHECK(host.control(status_of_device, 0, 0, 2) == Bytes{0, 0});
    CHECK(host.is_refused(0x0005, 200, 0, 0));
    REQUIRE(host.control(0x0005, 77, 0, 0)); // SET_ADDRESS, answered at the old one
    host.turn();
    CHECK(bench.controller.address() == 77);
    host.address = 77;
    // Addressed: there are no interfaces and endpoints.
    CHECK(host.control(get_configuration, 0, 0, 1) == Bytes{0});
    CHECK(host.is_refused(status_of_interface, 0, 0, 2));
    CHECK(host.is_refused(status_of_endpoint, 0, 0x82, 2));
    CHECK(host.is_refused(set_halt, 0, 0x82, 0));
    CHECK(host.is_refused(0x2122, 1, 0, 0));
    CHECK(host.control(status_of_endpoint, 0, 0, 2) == Bytes{0, 0});
    CHECK(host.control(status_of_endpoint, 0, 0x80, 2) == Bytes{0, 0});
    CHECK(host.is_refused(set_configuration, 2, 0, 0));
    REQUIRE(host.configure());
    CHECK(host.control(get_configuration, 0, 0, 1) == Bytes{1});
    CHECK(host.control(status_of_interface, 0, 0, 2) == Bytes{0, 0});
    CHECK(host.control(status_of_interface, 0, 1, 2) == Bytes{0, 0});
    CHECK(host.is_refused(status_of_interface, 0, 2, 2));
    CHECK(host.control(0x810a, 0, 1, 1) == Bytes{0}); // GET_INTERFACE
    CHECK(host.is_refused(0x810a, 0, 2, 1));
    CHECK(host.is_refused(0x010b, 0, 1, 0)); // SET_INTERFACE: 9.4.10, for interfaces of one setting
    CHECK(host.is_refused(0x010b, 1, 1, 0));
    CHECK(host.is_refused(0x010b, 0, 2, 0));
    for (const unsigned each : {0x81U, 0x82U, 0x02U}) {
        CAPTURE(each);
        const auto endpoint = static_cast<std::uint16_t>(each);
        CHECK(host.control(status_of_endpoint, 0, endpoint, 2) == Bytes{0, 0});
        CHECK(host.control(set_halt, 0, endpoint, 0));
        CHECK(host.control(status_of_endpoint, 0, endpoint, 2) == Bytes{1, 0});
        CHECK(host.is_refused(set_halt, 1, endpoint, 0)); // no such feature
        CHECK(host.control(clear_halt, 0, endpoint, 0));
        CHECK(host.control(status_of_endpoint, 0, endpoint, 2) == Bytes{0, 0});
    }
    for (const unsigned each : {0x01U, 0x83U, 0x0fU, 0x182U}) {
        const auto endpoint = static_cast<std::uint16_t>(each);
        CHECK(host.is_refused(status_of_endpoint, 0, endpoint, 2));
        CHECK(host.is_refused(clear_halt, 0, endpoint, 0));
    }
    CHECK(host.is_refused(0x0003, 1, 0, 0)); // SET_FEATURE: remote wakeup, test mode
    CHECK(host.is_refused(0x0003, 2, 0x100, 0));
    CHECK(host.is_refused(0x0001, 1, 0, 0));
    CHECK(host.is_refused(0x0007, 0x0100, 0, 18, Bytes(18))); // SET_DESCRIPTOR
    CHECK(host.is_refused(0x820c, 0, 0x82, 2));               // SYNCH_FRAME
    CHECK(host.is_refused(0xc0ee, 0, 4, 16));                 // vendor
    CHECK(host.is_refused(0x2123, 100, 0, 0));                // SEND_BREAK: not in the capabilities
    // Line coding is kept, whatever it says.
    const Bytes coding{0x80, 0x25, 0, 0, 2, 1, 7};
    CHECK(host.control(0xa121, 0, 0, 7) == Bytes{0x00, 0xc2, 0x01, 0, 0, 0, 8});
    CHECK(host.control(0x2120, 0, 0, 7, coding));
    CHECK(host.control(0xa121, 0, 0, 7) == coding);
    CHECK(host.is_refused(0x2120, 0, 0, 8, Bytes(8)));
    CHECK(host.is_refused(0x2120, 0, 1, 7, coding)); // another interface
    CHECK(host.control(0xa121, 0, 0, 7) == coding);
    REQUIRE(host.control(set_configuration, 0, 0, 0));
    CHECK(host.control(get_configuration, 0, 0, 1) == Bytes{0});
    CHECK_FALSE(host.control(status_of_endpoint, 0, 0x82, 2));
    Bytes packet;
    CHECK_FALSE(host.read(packet));
    CHECK_FALSE(host.write({1}));
}

TEST_CASE("USB: a reset of the bus takes address, configuration and sender, at any instant", "[usb]") {
    for (int cut = 0; cut < 60; ++cut) {
        CAPTURE(cut);
        Bench bench(static_cast<std::uint64_t>(cut));
        int accesses = 0;
        bench.controller.meanwhile = [&] {
            if (++accesses == 40 * cut) {
                bench.controller.reset_bus();
            }
        };
        (void)bench.host.open();
        bench.controller.meanwhile = nullptr;
        bench.host.reset();
        CHECK_FALSE(bench.serial.is_open());
        CHECK(bench.controller.address() == 0);
        CHECK(bench.host.control(status_of_device, 0, 0, 2) == Bytes{0, 0});
        CHECK_FALSE(bench.host.control(status_of_endpoint, 0, 0x82, 2));
        CHECK(bench.host.open());
        CHECK(bench.serial.is_open());
    }
}

TEST_CASE("USB: a SETUP breaks off whatever came before", "[usb][random]") {
    const int rounds = splinefeed_test::rounds(300);
    for (int round = static_cast<int>(splinefeed_test::first_round()); round < rounds; ++round) {
        CAPTURE(round);
        Bench bench(static_cast<std::uint64_t>(round));
        UsbHost& host = bench.host;
        REQUIRE(host.enumerate());
        for (int i = 0; i < 20; ++i) {
            constexpr std::array<std::uint16_t, 16> requests{0x8000, 0x8100, 0x8200, 0x0201, 0x0203, 0x8006,
                                                             0x8008, 0x810a, 0x010b, 0x2120, 0xa121, 0x2122,
                                                             0x8006, 0x0001, 0x2020, 0xffff};
            const std::uint16_t request = host.chance() ? requests.at(host.random() % requests.size())
                                                        : static_cast<std::uint16_t>(host.random());
            if (request == 0x0005 || request == 0x0009) {
                continue; // the host would not know any more where the device is
            }
            const auto any = [&host](std::uint16_t below) {
                return static_cast<std::uint16_t>(host.chance() ? host.random() % below : host.random());
            };
            const std::uint16_t value = host.chance() ? std::uint16_t{0x0200} : any(4);
            (void)host.setup(request, value, host.chance() ? std::uint16_t{0x82} : any(3), any(80));
            for (std::uint64_t steps = host.random() % 6; steps > 0; --steps) { // it goes on for a while
                Bytes packet;
                bool data1 = false;
                switch (host.random() % 4) {
                case 0: (void)bench.controller.in(host.address, 0, packet, data1, host.chance()); break;
                case 1:
                    (void)bench.controller.out(host.address, 0, Bytes(host.random() % 65, 0x55), host.chance());
                    break;
                default: host.turn(); break;
                }
            }
            if (host.chance()) { // a host that hears nothing waits before it asks for something else
                host.turn();
                (void)host.setup(get_descriptor, 0x0100, 0, 18);
                host.turn();
                REQUIRE(host.control(get_descriptor, 0x0100, 0, 18).value().size() == 18);
            }
        }
        REQUIRE(host.open());
        REQUIRE(bench.controller.misuse.empty());
    }
}
