// SPDX-License-Identifier: MIT
// What drives on Modbus TCP cost: exchanges one by one, and motion in real time through the port. The simulated drives
// are processes of their own on the loopback. items_per_second counts segments of the whole machine (three axes).
#include "host_sim/ports/histogram_picture.hpp"

#include "host_sim/drive/drive_server.hpp"
#include "host_sim/drive/pvt_drive.hpp"
#include "splinefeed/base/units.hpp"
#include "splinefeed/hal/modbus/link/modbus_link.hpp"
#include "splinefeed/hal/modbus/pvt/modbus_port.hpp"
#include "splinefeed/hal/rt/clock.hpp"

#include <benchmark/benchmark.h>

#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

std::atomic<std::uint64_t> allocations{0};

} // namespace

// Of glibc; everything that this process allocates comes along here, libraries too.
extern "C" {
void* __libc_malloc(std::size_t size);                    // NOLINT
void* __libc_calloc(std::size_t count, std::size_t size); // NOLINT
void* __libc_realloc(void* old, std::size_t size);        // NOLINT
void* malloc(std::size_t size) {                          // NOLINT
    allocations.fetch_add(1, std::memory_order_relaxed);
    return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) { // NOLINT
    allocations.fetch_add(1, std::memory_order_relaxed);
    return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) { // NOLINT
    allocations.fetch_add(1, std::memory_order_relaxed);
    return __libc_realloc(old, size);
}
}

namespace {

using namespace splinefeed;
using namespace splinefeed::hal::modbus;

constexpr int machine_axes = 3;
constexpr std::int64_t usual_ring = 512;

volatile std::sig_atomic_t stop = 0;

/// A simulated drive in a process of its own; it ends with this object, or with this process.
class DriveChild {
public:
    DriveChild(int axes, std::int64_t ring) {
        int ends[2];
        if (pipe(ends) != 0) {
            std::abort();
        }
        process_ = fork();
        if (process_ == 0) {
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            host::PvtDrive drive({.axes = std::vector<host::PvtAxisParameters>(static_cast<unsigned>(axes)),
                                  .ring = static_cast<std::uint16_t>(ring)});
            host::DriveServer server(drive, {}, {}, 1);
            const int port = server.address().port;
            if (write(ends[1], &port, sizeof(port)) == sizeof(port)) {
                server.run(stop, nullptr);
            }
            _exit(0);
        }
        if (read(ends[0], &address_.port, sizeof(address_.port)) != sizeof(address_.port)) {
            std::abort();
        }
        close(ends[0]);
        close(ends[1]);
    }
    DriveChild(const DriveChild&) = delete;
    DriveChild& operator=(const DriveChild&) = delete;
    ~DriveChild() {
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }
    [[nodiscard]] const LinkAddress& address() const { return address_; }

private:
    pid_t process_ = -1;
    LinkAddress address_;
};

void tell(benchmark::State& state, const hal::TimeHistogram& trips) {
    state.counters["half_us"] = trips.below_us(0.5);
    state.counters["99%_us"] = trips.below_us(0.99);
    state.counters["worst_us"] = static_cast<double>(trips.most_ns()) * 1e-3;
}

/// One exchange after the other by function 23: a block full of segments there, the status back. The drive has no
/// session, and says so: what is measured is the way there and back.
void exchange(benchmark::State& state) {
    const auto axes = static_cast<int>(state.range(0));
    const DriveChild drive(axes, usual_ring);
    ModbusLink link(drive.address(), {});
    if (!link.connect()) {
        state.SkipWithError("no connection");
        return;
    }
    PvtBlock block;
    block.count = static_cast<std::uint16_t>(pvt::most_segments(axes));
    PvtSegments segments{};
    PvtBlockRegisters registers{};
    const std::size_t size = encode(block, segments, axes, registers);
    std::array<std::uint16_t, pvt::status_registers(max_axes)> raw{};
    const auto status = std::span(raw).first(pvt::status_registers(axes));
    hal::TimeHistogram trips;
    for (auto _ : state) {
        const LinkAnswer answer =
            link.exchange(1, pvt::block_address, std::span(registers).first(size), pvt::status_address, status);
        if (!answer.ok()) {
            state.SkipWithError(describe(answer.fault));
            return;
        }
        trips.add((answer.answered_us - answer.sent_us) * 1000);
    }
    state.counters["registers_out"] = static_cast<double>(size);
    state.counters["segments_a_s"] =
        benchmark::Counter(static_cast<double>(state.iterations() * block.count), benchmark::Counter::kIsRate);
    tell(state, trips);
    if (std::getenv("SPLINEFEED_HISTOGRAM") != nullptr) {
        std::fputs(host::histogram_picture(trips).c_str(), stderr);
    }
}

/// To and fro along a sine, all axes alike, from rest to rest.
FeedSegment sine_segment(std::int64_t index, std::int64_t count, std::uint32_t ticks) {
    constexpr double pi = 3.14159265358979323846;
    constexpr double counts = 20000.0;
    const double turn = 2.0 * pi / static_cast<double>(count) * std::ceil(static_cast<double>(count) / 8000.0);
    const auto at = [&](std::int64_t i, bool velocity) {
        const double u = turn * static_cast<double>(i);
        const double value = velocity ? counts * turn * std::sin(u) : counts * (1.0 - std::cos(u));
        return i == count && velocity ? 0 : static_cast<std::int64_t>(value * static_cast<double>(units_per_count));
    };
    FeedSegment out;
    out.index = static_cast<std::uint64_t>(index);
    out.duration_ticks = ticks;
    out.start.fill(at(index, false));
    out.end.fill(at(index + 1, false));
    out.start_velocity.fill(at(index, true));
    out.end_velocity.fill(at(index + 1, true));
    return out;
}

/// So many drives, each with a ring of so many segments, share the three axes; segments of so many microseconds, for
/// four seconds of motion. Real time: what counts is that no drive ran out of segments (stops) and what it cost.
void sustained(benchmark::State& state) {
    const auto drives = static_cast<int>(state.range(0));
    const auto ticks = static_cast<std::uint32_t>(ticks_per_us * static_cast<std::uint64_t>(state.range(1)));
    const std::int64_t count = 4'000'000 / state.range(1);
    std::vector<std::unique_ptr<DriveChild>> children;
    std::vector<DriveWiring> wiring;
    for (int i = 0; i < drives; ++i) {
        children.push_back(std::make_unique<DriveChild>(machine_axes / drives, state.range(2)));
        wiring.push_back({.link = children.back()->address(),
                          .axes = drives == 1 ? std::vector<PvtAxis>{0, 1, 2} : std::vector<PvtAxis>{i}});
    }
    for (auto _ : state) {
        ModbusPort port(wiring, {});
        if (port.open() || port.prepare(sine_segment(0, count, ticks))) {
            state.SkipWithError("a drive is not ready");
            return;
        }
        const std::uint64_t busy_before = port.busy_us();
        const std::uint64_t allocated_before = allocations.load();
        const std::uint64_t before_us = hal::system_clock().now_us();
        for (std::int64_t i = 0; i < count && port.phase() != ModbusPhase::fault;) {
            while (i < count && port.room() > 0) {
                static_cast<void>(port.submit(sine_segment(i++, count, ticks)));
            }
            port.poll();
            hal::system_clock().sleep_until_us(hal::system_clock().now_us() + 1000);
        }
        port.complete();
        while (port.phase() != ModbusPhase::done && port.phase() != ModbusPhase::fault) {
            port.poll();
            hal::system_clock().sleep_until_us(hal::system_clock().now_us() + 1000);
        }
        const auto all = static_cast<double>(count);
        state.counters["allocations"] = static_cast<double>(allocations.load() - allocated_before);
        state.counters["stops"] = port.resumes();
        state.counters["bus_us_a_segment"] = static_cast<double>(port.busy_us() - busy_before) / all;
        state.counters["segments_a_s"] = 1e6 * all / static_cast<double>(hal::system_clock().now_us() - before_us);
        std::uint64_t exchanges = 0;
        for (std::size_t i = 0; i < port.drives(); ++i) {
            exchanges += port.report(i).counts.exchanges;
        }
        state.counters["segments_an_exchange"] = all * drives / static_cast<double>(exchanges);
        if (port.phase() == ModbusPhase::fault) {
            state.SkipWithError(port.failure().what.c_str());
        }
    }
}

// NOLINTBEGIN
BENCHMARK(exchange)->Arg(1)->Arg(3)->UseRealTime();
BENCHMARK(sustained)
    ->ArgsProduct({{1, 3}, {1000}, {usual_ring}})
    ->ArgsProduct({{1, 3}, {250, 200, 125, 100}, {2048}}) // 512 of them would not last for what a stop of all needs
    ->ArgNames({"drives", "segment_us", "ring"})
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kSecond);
// NOLINTEND

} // namespace
