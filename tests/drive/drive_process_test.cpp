// SPDX-License-Identifier: MIT
// The tool as a process, spoken to by programs and libraries that know nothing of it.
#include "drive_process.hpp"
#include "pvt_bench.hpp"
#include "support/catch.hpp"
#include "support/places.hpp"

#include <modbus/modbus.h>
#include <poll.h>
#include <unistd.h>

using namespace splinefeed::hal::modbus;
using splinefeed::test::DriveProcess;
using splinefeed::test::Tool;

namespace {

/// A client on libmodbus.
class Client {
public:
    explicit Client(modbus_t* context, int axes = 2) : context_(context), axes_(axes) {
        modbus_set_slave(context_, 1);
        modbus_set_response_timeout(context_, 1, 0);
    }
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;
    ~Client() {
        modbus_close(context_);
        modbus_free(context_);
    }

    [[nodiscard]] bool connect() { return modbus_connect(context_) == 0; }
    [[nodiscard]] modbus_t* context() { return context_; }

    /// By function 23, or by 16 and 03; nothing where the exchange failed.
    std::optional<PvtStatus> exchange(PvtBlock block, const std::vector<PvtSegment>& segments = {},
                                      bool with_23 = true) {
        block.nonce = ++nonce_;
        block.session = 5;
        block.count = static_cast<std::uint16_t>(segments.size());
        PvtBlockRegisters out{};
        const int size = static_cast<int>(encode(block, segments, axes_, out));
        std::vector<std::uint16_t> in(pvt::status_registers(axes_));
        const int count = static_cast<int>(in.size());
        const bool done = with_23 ? modbus_write_and_read_registers(context_, 0x0100, size, out.data(), 0x0020, count,
                                                                    in.data()) == count
                                  : modbus_write_registers(context_, 0x0100, size, out.data()) == size &&
                                        modbus_read_registers(context_, 0x0020, count, in.data()) == count;
        if (!done || !status_holds(in)) {
            UNSCOPED_INFO((done ? "checksum" : modbus_strerror(errno)));
            return std::nullopt;
        }
        const PvtStatus status = decode_status(in, axes_);
        return status.nonce == nonce_ ? std::optional(status) : std::nullopt;
    }
    std::optional<PvtStatus> command(PvtCommand command, std::uint32_t argument = 0, bool with_23 = true) {
        return exchange({.command = command, .command_counter = ++counter_, .argument = argument}, {}, with_23);
    }

private:
    modbus_t* context_;
    int axes_;
    std::uint16_t nonce_ = 0;
    std::uint16_t counter_ = 0;
};

/// From 0 to 10 and 20 counts in 20 ms, at rest.
std::vector<PvtSegment> short_motion() {
    auto segments = splinefeed_test::steady(2, 2, 80000, 500.0);
    for (unsigned k = 0; k < 2; ++k) {
        segments[0].end_velocity[k] = segments[0].end_velocity[k] * 3 / 2;
        segments[1].end_velocity[k] = 0;
    }
    segments[1].rest = true;
    return segments;
}

/// Enables, begins, sends, starts, waits for the end.
void drive_short_motion(Client& client, bool with_23) {
    REQUIRE(client.command(PvtCommand::enable, 0, with_23));
    REQUIRE(client.command(PvtCommand::begin, 100, with_23));
    const auto fed = client.exchange({.first = 100}, short_motion(), with_23);
    REQUIRE(fed);
    CHECK(fed->refused == PvtRefusal::none);
    CHECK(fed->next == 102);
    REQUIRE(client.command(PvtCommand::start, fed->clock_us + 5000, with_23));
    std::optional<PvtStatus> status;
    for (int i = 0; i < 1000; ++i) {
        status = client.exchange({}, {}, with_23);
        REQUIRE(status);
        if (status->executed == 102) {
            break;
        }
        usleep(1000);
    }
    CHECK(status->state == PvtState::standing);
    CHECK(status->position[0] == 10);
    CHECK(status->position[1] == 20);
}

bool installed(const Tool& tool, const std::string& program) {
    if (tool.shell("command -v " + program).status == 0) {
        return true;
    }
    WARN("SKIPPED: " << program << " is not installed");
    return false;
}

} // namespace

TEST_CASE("Drive process: functions 01, 02, 04 and 05, spoken to by libmodbus", "[process]") {
    const Tool tool;
    DriveProcess process(tool, "--profile vfd-h100 --ramp 1000 --listen tcp://127.0.0.1:0");
    Client client(modbus_new_tcp("127.0.0.1", process.port()));
    REQUIRE(client.connect());
    modbus_t* const line = client.context();
    std::uint16_t output = 7;
    REQUIRE(modbus_read_input_registers(line, 0, 1, &output) == 1);
    CHECK(output == 0);
    CHECK(modbus_write_register(line, 0x0201, 500) == 1); // 50 Hz
    CHECK(modbus_write_bit(line, 0x0049, 1) == 1);
    usleep(200'000);
    REQUIRE(modbus_read_input_registers(line, 0, 1, &output) == 1);
    CHECK(output == 500);
    std::uint16_t holding = 0;
    CHECK(modbus_read_registers(line, 0, 1, &holding) == -1); // another table
    CHECK(errno == EMBXILADD);
    std::uint8_t bit = 0;
    CHECK(modbus_read_bits(line, 0x0049, 1, &bit) == -1); // that coil is written only
    CHECK(errno == EMBXILADD);
    CHECK(modbus_read_input_bits(line, 0, 1, &bit) == -1);
    CHECK(errno == EMBXILFUN);
    CHECK(modbus_write_bit(line, 0x0048, 1) == -1);
    CHECK(errno == EMBXILADD);
    CHECK(process.stop() == 0);

    DriveProcess mx2(tool, "--profile vfd-omron-mx2 --ramp 1000 --listen tcp://127.0.0.1:0");
    Client other(modbus_new_tcp("127.0.0.1", mx2.port()));
    REQUIRE(other.connect());
    REQUIRE(modbus_read_bits(other.context(), 0, 1, &bit) == 1); // run
    CHECK(bit == 0);
    CHECK(modbus_write_bit(other.context(), 0, 1) == 1);
    REQUIRE(modbus_read_bits(other.context(), 0, 1, &bit) == 1);
    CHECK(bit == 1);
    CHECK(mx2.stop() == 0);
}

TEST_CASE("drive: a short motion over TCP, and its records", "[drive][process]") {
    for (const bool with_23 : {true, false}) {
        const Tool tool;
        DriveProcess drive(tool, "--listen tcp://127.0.0.1:0 --axes 2 --record t.csv --record-segments s.csv");
        CAPTURE(drive.line(), drive.error());
        CHECK(drive.line().find("listening on tcp://127.0.0.1:") == 0);
        CHECK(drive.line().find(", profile splinefeed-pvt, 2 axes") != std::string::npos);
        Client client(modbus_new_tcp("127.0.0.1", drive.port()));
        REQUIRE(client.connect());
        Client other(modbus_new_tcp("127.0.0.1", drive.port()));
        REQUIRE(other.connect());
        drive_short_motion(client, with_23);
        std::array<std::uint16_t, 11> identity{};
        CHECK(modbus_read_registers(other.context(), 0, 11, identity.data()) == 11);
        CHECK(modbus_read_registers(other.context(), 0x0200, 1, identity.data()) == -1);
        CHECK(errno == EMBXILADD);
        CHECK(modbus_write_register(other.context(), 0x0011, 0) == -1);
        CHECK(errno == EMBXILVAL);
        CHECK(modbus_write_register(other.context(), 0x0011, 50) == 1);
        CHECK(modbus_read_bits(other.context(), 0, 1, std::array<std::uint8_t, 1>{}.data()) == -1);
        CHECK(errno == EMBXILFUN);
        CHECK(modbus_mask_write_register(other.context(), 0x0011, 0xFFFF, 0) == -1);
        CHECK(errno == EMBXILFUN);
        CHECK(drive.stop() == 0);

        std::istringstream rows(tool.read("t.csv"));
        std::string row;
        REQUIRE(std::getline(rows, row));
        CHECK(row.find("splinefeed-pvt") != std::string::npos);
        REQUIRE(std::getline(rows, row));
        CHECK(row.find("# t = 0 is CLOCK_MONOTONIC ") == 0);
        REQUIRE(std::getline(rows, row));
        CHECK(row == "t,a0,a1");
        int count = 0;
        double last = 0.0;
        bool moved = false;
        for (; std::getline(rows, row); ++count) {
            double t = 0.0;
            double a0 = 0.0;
            double a1 = 0.0;
            REQUIRE(std::sscanf(row.c_str(), "%lf,%lf,%lf", &t, &a0, &a1) == 3);
            REQUIRE(t == Approx(0.001 * count).margin(1e-9));
            REQUIRE(a1 == Approx(2.0 * a0).margin(2e-6));
            REQUIRE(a0 >= last);
            moved = moved || (a0 > 0.0 && a0 < 10.0);
            last = a0;
        }
        CHECK(moved);
        CHECK(last == 10.0);
        const std::string segments = tool.read("s.csv");
        CHECK(segments.find("\nsequence,duration_ticks,a0_end,a0_v_end,a1_end,a1_v_end,t_end\n100,80000,327680,") !=
              std::string::npos);
        CHECK(segments.find("\n101,80000,655360,0,1310720,0,") != std::string::npos);
    }
}

TEST_CASE("drive: a frame in pieces, one with nonsense, and a client that goes away", "[drive][process]") {
    const Tool tool;
    DriveProcess drive(tool, "--listen tcp://127.0.0.1:0 --axes 2");
    Client client(modbus_new_tcp("127.0.0.1", drive.port()));
    REQUIRE(client.connect());
    const std::array<std::uint8_t, 12> request{0, 1, 0, 0, 0, 6, 1, 3, 0, 0, 0, 1};
    const int line = modbus_get_socket(client.context());
    REQUIRE(write(line, request.data(), 5) == 5);
    {
        Client brief(modbus_new_tcp("127.0.0.1", drive.port()));
        REQUIRE(brief.connect());
        REQUIRE(write(modbus_get_socket(brief.context()), request.data(), 7) == 7);
    }
    Client other(modbus_new_tcp("127.0.0.1", drive.port()));
    REQUIRE(other.connect());
    CHECK(other.exchange({}));
    REQUIRE(write(line, request.data() + 5, 7) == 7);
    std::array<std::uint8_t, 32> reply{};
    pollfd answer{line, POLLIN, 0};
    REQUIRE(poll(&answer, 1, 1000) == 1);
    CHECK(read(line, reply.data(), reply.size()) == 11);
    CHECK(reply[9] == 0x53);
    std::array<std::uint8_t, 12> nonsense{};
    nonsense.fill(0xFF);
    REQUIRE(write(line, nonsense.data(), nonsense.size()) == 12);
    CHECK(other.exchange({}));
    CHECK(drive.stop() == 0);
}

TEST_CASE("drive: faults come as asked", "[drive][process]") {
    const Tool tool;
    {
        DriveProcess drive(tool, "--listen tcp://127.0.0.1:0 --axes 2 --faults exception=1,seed=1");
        Client client(modbus_new_tcp("127.0.0.1", drive.port()));
        REQUIRE(client.connect());
        CHECK_FALSE(client.command(PvtCommand::enable));
        CHECK((errno == EMBXSFAIL || errno == EMBXSBUSY));
        CHECK(drive.error().empty());
    }
    {
        // Each kind of damage is found out, and in the end everything was done once.
        DriveProcess drive(tool, "--listen tcp://127.0.0.1:0 --axes 2 --record-segments s.csv "
                                 "--faults drop=0.05,corrupt=0.2,duplicate=0.2,stale=0.1,exception=0.1,delay=5:0.1");
        CHECK(drive.error().find("splinefeed: --faults seed=") == 0);
        INFO(drive.error());
        Client client(modbus_new_tcp("127.0.0.1", drive.port()));
        modbus_set_response_timeout(client.context(), 0, 15000);
        REQUIRE(client.connect());
        const auto segments = short_motion();
        std::uint16_t counter = 0;
        const auto insist = [&](PvtBlock block, const std::vector<PvtSegment>& with = {}) {
            for (int i = 0; i < 100; ++i) {
                const auto status = client.exchange(block, with);
                if (status && status->refused == PvtRefusal::none &&
                    (block.command == PvtCommand::none || status->last_command == block.command_counter)) {
                    return *status;
                }
                usleep(1000);
                modbus_close(client.context());
                REQUIRE(client.connect());
            }
            FAIL("no exchange succeeds");
            return PvtStatus{};
        };
        insist({.command = PvtCommand::enable, .command_counter = ++counter});
        insist({.command = PvtCommand::begin, .command_counter = ++counter, .argument = 100});
        insist({.first = 100}, segments);
        const PvtStatus status = insist({.first = 100}, segments);
        CHECK(status.next == 102);
        insist({.command = PvtCommand::start, .command_counter = ++counter, .argument = status.clock_us});
        usleep(30000);
        CHECK(insist({}).executed == 102);
        CHECK(drive.stop() == 0);
        const std::string record = tool.read("s.csv");
        CHECK(std::count(record.begin(), record.end(), '\n') == 4);
    }
    {
        DriveProcess drive(tool, "--listen tcp://127.0.0.1:0 --axes 2 --faults disconnect@0.1:100");
        Client client(modbus_new_tcp("127.0.0.1", drive.port()));
        REQUIRE(client.connect());
        int failed = 0;
        bool back = false;
        for (int i = 0; i < 1000 && !(failed > 0 && back); ++i) {
            usleep(1000);
            const bool answered = client.exchange({}).has_value();
            back = failed > 0 && answered;
            if (!answered) {
                ++failed;
                modbus_close(client.context());
                static_cast<void>(client.connect());
            }
        }
        CHECK(failed > 0);
        CHECK(back);
    }
}

TEST_CASE("drive: over a serial line, at its pace", "[drive][process]") {
    const Tool tool;
    if (!installed(tool, "socat")) {
        return;
    }
    REQUIRE(tool.shell("socat pty,raw,echo=0,link=A pty,raw,echo=0,link=B >/dev/null 2>&1 & echo $! >cable; "
                       "for i in $(seq 200); do [ -e A ] && [ -e B ] && exit 0; sleep 0.01; done; exit 1")
                .status == 0);
    const std::string path = tool.folder() + "/";
    for (const bool paced : {false, true}) {
        CAPTURE(paced);
        DriveProcess drive(tool, "--listen 'rtu://" + path + "A?baud=115200&parity=N&unit=1" +
                                     (paced ? "" : "&pace=off") + "' --axes 2");
        CHECK(drive.line().find("listening on rtu://") == 0);
        Client client(modbus_new_rtu((path + "B").c_str(), 115200, 'N', 8, 1));
        REQUIRE(client.connect());
        std::array<std::uint16_t, 64> registers{};
        const auto start = std::chrono::steady_clock::now();
        CHECK(modbus_read_registers(client.context(), 0x0020, 26, registers.data()) == 26);
        const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
        if (paced) {
            // 8 and 57 characters of 11 bits, and 1.75 ms of silence between them
            CHECK(took.count() >= 65 * 11 / 0.1152 + 1750 - 10);
        }
        drive_short_motion(client, paced);
        modbus_set_slave(client.context(), 2);
        modbus_set_response_timeout(client.context(), 0, 30000);
        CHECK(modbus_read_registers(client.context(), 0x0020, 1, registers.data()) == -1);
        CHECK(errno == ETIMEDOUT);
        CHECK(drive.stop() == 0);
    }
    static_cast<void>(tool.shell("kill $(cat cable)"));
}

TEST_CASE("drive: mbpoll reads and writes the registers of Kinco", "[drive][process]") {
    const Tool tool;
    if (!installed(tool, "mbpoll")) {
        return;
    }
    const DriveProcess drive(tool, "--listen tcp://127.0.0.1:0 --position -2 --profile cia402-kinco");
    CHECK(drive.line().find(", profile cia402-kinco, 1 axis") != std::string::npos);
    const std::string mbpoll = "mbpoll -m tcp -p " + std::to_string(drive.port()) + " -a 1 -0 -1 ";
    for (const char* word : {"6", "15"}) {
        CHECK(tool.shell(mbpoll + "-t 4 -r 12544 127.0.0.1 " + word).status == 0); // 0x3100
    }
    const auto status = tool.shell(mbpoll + "-t 4:hex -r 12800 -c 1 127.0.0.1"); // 0x3200
    CAPTURE(status.output, status.error);
    CHECK(status.output.find("0x0637") != std::string::npos);                      // operation enabled, target reached
    const auto position = tool.shell(mbpoll + "-t 4:hex -r 14080 -c 2 127.0.0.1"); // 0x3700, low word first
    CAPTURE(position.output);
    CHECK(position.output.find("0xFFFE") < position.output.find("0xFFFF"));
}

TEST_CASE("drive: pymodbus drives it, from the document alone", "[drive][process]") {
    const Tool tool;
    if (tool.shell("/usr/bin/python3 -c 'import pymodbus'").status != 0) {
        WARN("SKIPPED: python3-pymodbus is not installed");
        return;
    }
    DriveProcess drive(tool, "--listen tcp://127.0.0.1:0 --axes 3 --position 10,-20,30");
    const auto call = tool.shell("/usr/bin/python3 " + splinefeed::test::source_folder() +
                                 "/tests/drive/pvt_client.py " + std::to_string(drive.port()));
    CAPTURE(call.output, call.error);
    CHECK(call.status == 0);
    CHECK(call.output == "executed 9 end 110 -220 330\n");
    CHECK(drive.stop() == 0);
}

TEST_CASE("drive: its profiles and its help", "[drive][process]") {
    const Tool tool;
    CHECK(tool("drive --list-profiles").output.find("\nsplinefeed-pvt  buffered segments") != std::string::npos);
    CHECK(tool("drive --help").output.find("Example: splinefeed drive") != std::string::npos);
}
