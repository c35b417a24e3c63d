// SPDX-License-Identifier: MIT
// InputWatch on a chip of the test and a virtual clock: what acts, since when, and where the axes stood.
#include "splinefeed/hal/gpio/input_watch.hpp"
#include "support/catch.hpp"
#include "support/virtual_clock.hpp"

#include <cerrno>
#include <deque>

using namespace splinefeed;
using namespace splinefeed::hal::gpio;
using namespace splinefeed_test;

namespace {

/// On a virtual clock, whose threads take turns.
class ScriptedSource final : public InputSource {
public:
    explicit ScriptedSource(VirtualClock& clock) : clock_(&clock) {}
    [[nodiscard]] std::optional<std::uint64_t> levels() noexcept override { return levels_; }
    [[nodiscard]] int wait(std::span<InputEvent> out, std::uint32_t timeout_us) noexcept override {
        const std::uint64_t until_us = clock_->now_us() + timeout_us;
        while (!broken_ && events_.empty() && clock_->now_us() < until_us) {
            clock_->sleep_us(100);
        }
        if (broken_) {
            errno = ENODEV;
            return -1;
        }
        std::size_t count = 0;
        for (; !events_.empty() && count < out.size(); ++count) {
            out[count] = events_.front();
            events_.pop_front();
        }
        return static_cast<int>(count);
    }

    void drive(unsigned line, bool level, std::uint64_t time_ns, bool with_edge = true) {
        levels_ = (levels_ & ~(std::uint64_t{1} << line)) | (std::uint64_t{level} << line);
        if (with_edge) {
            events_.push_back({static_cast<std::uint8_t>(line), level, time_ns, 0});
        }
    }
    void vanish() { broken_ = true; }

private:
    VirtualClock* clock_;
    std::deque<InputEvent> events_;
    std::uint64_t levels_ = 0;
    bool broken_ = false;
};

struct Bench {
    explicit Bench(const std::vector<WatchedInput>& inputs)
        : watch(source, inputs, log, [this] { ++trips; }, {.clock = &clock}) {}

    template <class F>
    [[nodiscard]] bool soon(F condition) {
        for (int i = 0; i < 2000 && !condition(); ++i) {
            clock.sleep_us(1000);
        }
        return condition();
    }

    InputChange next() {
        std::optional<InputChange> change;
        REQUIRE(soon([&] { return change || (change = watch.take()); }));
        return *change;
    }

    VirtualClock clock;
    ScriptedSource source{clock};
    StepLog log;
    int trips = 0;
    InputWatch watch;
};

} // namespace

TEST_CASE("an input acts since its first edge, however it bounces, and tells where the axes stood then") {
    Bench bench({{.bit = 3, .active_level = true, .debounce_us = 2000}});
    const std::uint64_t t = bench.clock.now_ns() - 10'000'000; // no edge has an instant that is to come
    for (unsigned i = 0; i < 100; ++i) {                       // a step each 10 us, from there on
        bench.log.add(t + 10'000 * i, 0, true);
    }
    REQUIRE(bench.watch.start());
    CHECK_FALSE(bench.watch.active(0));
    const std::uint64_t edge = t + 405'000;
    for (int i = 0; i < 5; ++i) {
        bench.source.drive(3, i % 2 == 0, edge + static_cast<std::uint64_t>(i) * 20'000);
    }
    const InputChange change = bench.next();
    CHECK(change.input == 0);
    CHECK(change.active);
    CHECK(change.time_ns == edge);
    REQUIRE(change.counts.has_value());
    CHECK((*change.counts)[0] == 41); // at t, t + 10 us, ... t + 400 us
    CHECK(bench.watch.active(0));
    CHECK(bench.trips == 0);
    bench.source.drive(3, false, edge + 900'000'000);
    CHECK_FALSE(bench.next().active);
}

TEST_CASE("an input that trips the e-stop does so at its first edge, debounced or not") {
    Bench bench({{.bit = 0, .active_level = true, .debounce_us = 100'000, .trips_estop = true}, {.bit = 1}});
    REQUIRE(bench.watch.start());
    bench.source.drive(1, true, bench.clock.now_ns());
    CHECK(bench.next().input == 1);
    CHECK(bench.trips == 0);
    bench.source.drive(0, true, bench.clock.now_ns());
    CHECK(bench.soon([&] { return bench.trips > 0; }));
    CHECK_FALSE(bench.watch.active(0)); // that needs the time of debouncing
}

TEST_CASE("an edge that the system lost is noticed by the level") {
    Bench bench({{.bit = 5, .active_level = true, .trips_estop = true}});
    REQUIRE(bench.watch.start());
    bench.source.drive(5, true, 0, false);
    CHECK(bench.soon([&] { return bench.trips > 0; }));
    CHECK(bench.next().active);
    CHECK(bench.watch.missed() == 1);
}

TEST_CASE("a chip that vanishes disables the drives, with the system's reason") {
    Bench bench({WatchedInput{.bit = 5}});
    REQUIRE(bench.watch.start());
    CHECK(bench.watch.trouble().empty());
    bench.source.vanish();
    CHECK(bench.soon([&] { return bench.trips > 0; }));
    CHECK(bench.soon([&] { return bench.watch.trouble() == "No such device"; }));
}

TEST_CASE("an input that acts from the start is known before anything moves") {
    const std::vector<WatchedInput> both{{.bit = 2, .active_level = false}, {.bit = 2, .active_level = true}};
    Bench bench(both);
    REQUIRE(bench.watch.start());
    CHECK(bench.watch.active(0));
    CHECK_FALSE(bench.watch.active(1));
}
