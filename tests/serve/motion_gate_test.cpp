// SPDX-License-Identifier: MIT
//
// A disk that takes its time: nothing moves before it has the file, and nobody waits for it.
#include "host_sim/serve/motion_gate.hpp"

#include "host/refusal.hpp"
#include "host/temporary_folder.hpp"
#include "host_sim/base/output_file.hpp"
#include "support/catch.hpp"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <sys/syscall.h>
#include <thread>
#include <unistd.h>

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

using std::chrono::milliseconds;

std::atomic<bool> disk_is_slow{false};

const std::vector<std::string> xyz{"x", "y", "z"};

class CountedMachine final : public ServedMachine {
public:
    void advance(Time /*now*/) override {}
    [[nodiscard]] bool has_room() const override { return true; }
    [[nodiscard]] bool is_dry() const override { return true; }
    void submit(const FeedSegment& /*segment*/) override { ++segments; }
    void rest() override {}
    [[nodiscard]] bool stands() const override { return true; }
    [[nodiscard]] std::vector<RunTarget::AxisPlace> places() const override { return {{0, 1.0}, {1, 2.0}, {2, 3.0}}; }
    MachineReading read() noexcept override { return {}; }
    void obey(const ProgramEvent& /*event*/) noexcept override {}
    void watch_probe(bool /*away*/) noexcept override {}
    void home(std::uint32_t /*axes*/) noexcept override { ++homes; }
    bool halt() noexcept override { return false; }
    void quick_stop() noexcept override { ++stops; }
    void enable(bool /*on*/) noexcept override {}
    void reset_faults() noexcept override {}

    int segments = 0;
    int homes = 0;
    int stops = 0;
};

struct GateRun {
    TemporaryFolder folder{};
    std::string name = folder.file("state.json");
    StateFile file{name, {xyz}};
    StateKeeper state{file, {}, StateKeeper::Writes::behind};
    CountedMachine machine{};
    MotionGate gate{machine, &state};

    GateRun() { disk_is_slow.store(true); }
    ~GateRun() { disk_is_slow.store(false); }

    [[nodiscard]] bool file_knows_that_it_moves() const {
        const auto kept = std::filesystem::exists(name) ? read_state_file(name, xyz) : std::nullopt;
        return kept && !kept->position_mm[0] && !kept->unknown_why.empty();
    }
    void let_disk_write() {
        disk_is_slow.store(false);
        state.finish();
    }
};

} // namespace

// Instead of the C library's, for what is linked here.
extern "C" int fsync(int descriptor) {
    while (disk_is_slow.load()) {
        std::this_thread::sleep_for(milliseconds(1));
    }
    return static_cast<int>(::syscall(SYS_fsync, descriptor));
}

TEST_CASE_METHOD(GateRun, "a motion waits until the file says that it moves, and who obeys does not", "[serve]") {
    const auto begun = std::chrono::steady_clock::now();
    gate.submit({});
    for (int i = 0; i < 20; ++i) {
        gate.advance();
        std::this_thread::sleep_for(milliseconds(1));
    }
    CHECK(machine.segments == 0);
    CHECK_FALSE(gate.has_room());
    CHECK_FALSE(gate.stands());
    CHECK_FALSE(gate.read().stands);
    CHECK(std::chrono::steady_clock::now() - begun < std::chrono::seconds(5)); // the disk would never end
    let_disk_write();
    CHECK(file_knows_that_it_moves());
    gate.advance();
    CHECK(machine.segments == 1);
    gate.submit({});
    CHECK(machine.segments == 2);
}

TEST_CASE_METHOD(GateRun, "homing waits in the same way", "[serve]") {
    gate.home(7);
    gate.advance();
    CHECK(machine.homes == 0);
    CHECK(gate.read().homing == HomingPhase::busy);
    let_disk_write();
    CHECK(file_knows_that_it_moves());
    gate.advance();
    CHECK(machine.homes == 1);
    CHECK(gate.read().homing == HomingPhase::none);
}

TEST_CASE_METHOD(GateRun, "a stop goes through at once, and what waits is forgotten", "[serve]") {
    const bool homes = GENERATE(true, false);
    homes ? gate.home(7) : gate.submit({});
    gate.quick_stop();
    CHECK(machine.stops == 1);
    CHECK(gate.read().homing == (homes ? HomingPhase::failed : HomingPhase::none));
    CHECK(gate.stands());
    let_disk_write();
    gate.advance();
    CHECK(machine.segments + machine.homes == 0);
    CHECK(gate.has_moved()); // the file says so
}

TEST_CASE_METHOD(GateRun, "of many states the last one is written, and the end waits for it", "[serve]") {
    gate.submit({});
    WorkOffsets offsets;
    for (offsets.tool_number = 0; offsets.tool_number < 1000; ++offsets.tool_number) {
        state.offsets(offsets);
    }
    state.ends(machine.places());
    CHECK_FALSE(state.is_kept());
    let_disk_write();
    const auto kept = read_state_file(name, xyz);
    REQUIRE(kept.has_value());
    CHECK(kept->offsets.tool_number == 999);
    CHECK(kept->position_mm[2] == 3.0);
}

TEST_CASE_METHOD(GateRun, "a file that cannot be written lets nothing move", "[serve]") {
    disk_is_slow.store(false);
    std::filesystem::create_directory(name);
    gate.submit({});
    CHECK(refusal_of<OutputError>([&] { state.finish(); }).find(" is a directory, which cannot be replaced") !=
          std::string::npos);
    CHECK(state.has_failed());
    CHECK_THROWS(gate.advance());
    CHECK(machine.segments == 0);
}
