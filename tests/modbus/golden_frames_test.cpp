// SPDX-License-Identifier: MIT
// Frames from makers' manuals, byte for byte: libmodbus sends what profile and codec put into registers. Their
// checksums were recomputed; where a manual's own table contradicts its frame, the frame is what a drive takes.
#include "host_sim/config/shipped_profiles.hpp"
#include "splinefeed/hal/modbus/profile/field_codec.hpp"

#include "support/catch.hpp"

#include <array>
#include <modbus/modbus.h>
#include <sys/socket.h>
#include <unistd.h>

using namespace splinefeed::hal::modbus;
using splinefeed::host::find_profile;

namespace {

using Bytes = std::vector<int>;

/// An RTU client on one end of a socket pair, its bytes on the other. A reply is laid there before it is asked for.
class Wire {
public:
    explicit Wire(int unit) : client_(modbus_new_rtu("/dev/null", 19200, 'N', 8, 1)) {
        REQUIRE(client_ != nullptr);
        REQUIRE(socketpair(AF_UNIX, SOCK_STREAM, 0, ends_.data()) == 0);
        REQUIRE(modbus_set_slave(client_, unit) == 0);
        REQUIRE(modbus_set_socket(client_, ends_[0]) == 0);
        REQUIRE(modbus_set_response_timeout(client_, 0, 1000) == 0);
    }
    Wire(const Wire&) = delete;
    Wire& operator=(const Wire&) = delete;
    ~Wire() {
        modbus_free(client_);
        close(ends_[0]);
        close(ends_[1]);
    }

    void answer(const Bytes& reply) {
        const std::vector<std::uint8_t> bytes(reply.begin(), reply.end());
        REQUIRE(write(ends_[1], bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
    }
    [[nodiscard]] Bytes sent() {
        std::array<std::uint8_t, 300> bytes{};
        const ssize_t count = read(ends_[1], bytes.data(), bytes.size());
        return {bytes.begin(), bytes.begin() + count};
    }
    [[nodiscard]] modbus_t* client() const { return client_; }

private:
    modbus_t* client_;
    std::array<int, 2> ends_{};
};

const RegisterField& field_of(const DriveProfile& profile, FieldRole role) {
    const RegisterField* const field = profile.field_of(role);
    REQUIRE(field != nullptr);
    return *field;
}

/// Writes one field with function 16.
int write_field(const Wire& wire, const RegisterField& field, std::int64_t raw) {
    std::array<std::uint16_t, 4> registers{};
    put_raw(field, raw, registers);
    return modbus_write_registers(wire.client(), field.address, static_cast<int>(field.registers()), registers.data());
}

} // namespace

TEST_CASE("Golden frames of Kinco: control word, status word, target velocity low word first") {
    const DriveProfile profile = find_profile("cia402-kinco");
    Wire wire(1);
    const RegisterField& control = field_of(profile, FieldRole::control);
    const CommandStep run = profile.steps_of(DriveCommand::enable).back();
    wire.answer({0x01, 0x06, 0x31, 0x00, 0x00, 0x0F, 0xC7, 0x32});
    CHECK(modbus_write_register(wire.client(), control.address, static_cast<std::uint16_t>(run.value)) == 1);
    CHECK(wire.sent() == Bytes{0x01, 0x06, 0x31, 0x00, 0x00, 0x0F, 0xC7, 0x32});

    std::array<std::uint16_t, 2> status{};
    CHECK(modbus_read_registers(wire.client(), field_of(profile, FieldRole::status).address, 2, status.data()) == -1);
    CHECK(wire.sent() == Bytes{0x01, 0x03, 0x32, 0x00, 0x00, 0x02, 0xCA, 0xB3}); // nobody answers

    CHECK(write_field(wire, field_of(profile, FieldRole::target_velocity), 0x00085555) == -1);
    CHECK(wire.sent() == Bytes{0x01, 0x10, 0x6F, 0x00, 0x00, 0x02, 0x04, 0x55, 0x55, 0x00, 0x08, 0x1A, 0x47});
}

TEST_CASE("Golden frame of Leadshine: a positioning block in eight registers") {
    const DriveProfile profile = find_profile("leadshine-pr");
    const FieldGroup* const block = profile.group_for(GroupUse::target);
    REQUIRE(block != nullptr);
    REQUIRE(block->registers == 8);
    // 10000 counts, speed 0 (the manual's text says 200 rpm, its frame 0), ramps of 10000 ms per 1000 rpm.
    const auto raw = [&profile](FieldIndex index) {
        const RegisterField& field = profile.fields[index];
        switch (field.role) {
        case FieldRole::target_position: return raw_of(field, std::int64_t{10000} << physical_bits).raw;
        case FieldRole::profile_velocity: return raw_of(field, 0).raw;
        case FieldRole::profile_acceleration:
        case FieldRole::profile_deceleration: // 1000 rpm in 10 s, 10000 counts a turn
            return raw_of(field, (std::int64_t{1000} * 10000 << physical_bits) / 60 / 10).raw;
        default: return field.value;
        }
    };
    std::array<std::uint16_t, 8> registers{};
    for (const FieldIndex index : block->fields) {
        const RegisterField& field = profile.fields[index];
        put_raw(field, raw(index), std::span(registers).subspan(field.address - std::size_t{block->address}));
    }
    Wire wire(7);
    wire.answer({0x07, 0x10, 0x62, 0x00, 0x00, 0x08, 0xDE, 0x11});
    CHECK(modbus_write_registers(wire.client(), block->address, 8, registers.data()) == 8);
    CHECK(wire.sent() == Bytes{0x07, 0x10, 0x62, 0x00, 0x00, 0x08, 0x10, 0x00, 0x01, 0x00, 0x00, 0x27, 0x10,
                               0x00, 0x00, 0x27, 0x10, 0x27, 0x10, 0x00, 0x00, 0x00, 0x10, 0x8D, 0x50});

    registers[3] = 200; // what the manual's text means
    CHECK(modbus_write_registers(wire.client(), block->address, 8, registers.data()) == -1);
    const Bytes sent = wire.sent();
    CHECK(Bytes(sent.end() - 2, sent.end()) == Bytes{0xBA, 0x95});
}

TEST_CASE("Golden frames of Delta and Moons: the same 32 bits, low and high word first") {
    RegisterField delta;
    delta.address = 0x0112;
    delta.width_bits = 32;
    delta.word_order = Significance::low_first;
    Wire wire(1);
    std::array<std::uint16_t, 2> read{};
    CHECK(modbus_read_registers(wire.client(), 0x0200, 2, read.data()) == -1);
    CHECK(wire.sent() == Bytes{0x01, 0x03, 0x02, 0x00, 0x00, 0x02, 0xC5, 0xB3});
    wire.answer({0x01, 0x10, 0x01, 0x12, 0x00, 0x02, 0xE0, 0x31});
    CHECK(write_field(wire, delta, 3000) == 2);
    CHECK(wire.sent() == Bytes{0x01, 0x10, 0x01, 0x12, 0x00, 0x02, 0x04, 0x0B, 0xB8, 0x00, 0x00, 0xFC, 0xEB});

    RegisterField moons;
    moons.address = 0x001E;
    moons.width_bits = 32;
    Wire other(10);
    CHECK(write_field(other, moons, 30000) == -1);
    CHECK(other.sent() == Bytes{0x0A, 0x10, 0x00, 0x1E, 0x00, 0x02, 0x04, 0x00, 0x00, 0x75, 0x30, 0x70, 0x8F});
}
