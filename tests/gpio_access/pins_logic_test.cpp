// SPDX-License-Identifier: MIT
//
// What OutputPins and InputPins do with a chip, whichever libgpiod opens it.
#ifdef SPLINEFEED_HAS_GPIO
#include "gpio_access/fake_chip.hpp"
#include "host/refusal.hpp"
#include "splinefeed/hal/gpio/crash_guard.hpp"
#include "splinefeed/hal/gpio/input_pins.hpp"
#include "splinefeed/hal/gpio/output_pins.hpp"
#include "support/child.hpp"

#include <array>
#include <cerrno>
#include <csignal>

using namespace splinefeed::hal::gpio;
using splinefeed_test::fake_chip;
using Writes = std::vector<splinefeed_test::FakeChip::Write>;

namespace {

// Bits 0 to 2 are lines D, A and B; that of A is safe when high.
const std::vector<OutputRequest> three{{{"D", {}}, false}, {{"", 0}, true}, {{"B", 1}, false}};
constexpr std::uint64_t safe = 2;
constexpr std::uint64_t all = 7;

} // namespace

TEST_CASE("Output lines: safe from the request on, and before they are released") {
    {
        const OutputPins lines("chip", "test", three);
        CHECK(lines.size() == 3);
        CHECK(fake_chip.offsets == std::vector<unsigned>{3, 0, 1});
        CHECK(fake_chip.requested_levels == safe);
        CHECK(fake_chip.writes.empty());
    }
    CHECK((fake_chip.writes == Writes{{all, safe}}));
    CHECK(fake_chip.released);
}

TEST_CASE("Output lines: what is not in the mask stays, and each change is one write") {
    OutputPins lines("chip", "test", three);
    CHECK(lines.set(5, 5));
    CHECK(lines.set(2, 5)); // bits beside the mask do not count
    CHECK(lines.set(1, 0));
    CHECK(lines.set(0, 7)); // nothing to do
    CHECK((fake_chip.writes == Writes{{5, 7}, {2, 5}, {1, 4}}));
}

TEST_CASE("Output lines: a write that failed changes nothing and keeps errno") {
    OutputPins lines("chip", "test", three);
    fake_chip.write_error = ENODEV;
    errno = 0;
    CHECK_FALSE(lines.set(1, 1));
    CHECK(errno == ENODEV);
    errno = 4711;
    lines.make_safe();
    CHECK(errno == 4711);
    fake_chip.write_error = 0;
    CHECK(lines.set(4, 4));
    CHECK((fake_chip.writes == Writes{{4, 6}}));
}

TEST_CASE("Output lines: make_safe() while lines are being set has the last word") {
    OutputPins lines("chip", "test", three);
    CHECK(lines.set(all, 5));
    fake_chip.writes.clear();
    fake_chip.between = [&] {
        lines.make_safe();
    };
    CHECK_FALSE(lines.set(1, 0));
    CHECK(errno == ECANCELED);
    // The safe levels, then those that were on their way, and the safe ones again.
    CHECK((fake_chip.writes == Writes{{all, safe}, {1, 4}, {all, safe}}));
    CHECK(lines.set(4, 4)); // and it goes on from there
    CHECK((fake_chip.writes.back() == splinefeed_test::FakeChip::Write{4, 6}));
}

TEST_CASE("Output lines: those that are kept have the same level when they are released") {
    {
        OutputPins lines("chip", "test", three);
        CHECK(lines.set(all, 5));
        lines.retain_levels(4);
        fake_chip.writes.clear();
    }
    CHECK((fake_chip.writes == Writes{{all, safe | 4}}));
}

TEST_CASE("Output lines: who has a line that is busy, and what cannot be an output") {
    const auto refusal = [](const std::string& consumer, const PinName& line) {
        const std::vector<OutputRequest> one{{line, false}};
        return splinefeed_test::refusal_of<GpioError>([&] { OutputPins("chip", consumer, one); });
    };
    CHECK(refusal("refused", {"D", {}}) ==
          "line 3 ('D') of chip is in use by 'other'; stop that, or take another line");
    CHECK(refusal("refused", {"C", {}}) ==
          "line 2 ('C') of chip is in use by an unnamed consumer; stop that, or take another line");
    CHECK(refusal("no outputs", {"A", {}}).find("line 0 ('A') of chip cannot become an output: ") == 0);
}

TEST_CASE("Input lines: edges in order of time, time-outs, signals and failures") {
    InputPins lines("chip", "test", std::vector<InputRequest>{{{"C", {}}, Bias::as_is}, {{"A", {}}, Bias::as_is}});
    CHECK(lines.size() == 2);
    CHECK(lines.levels() == 5U);
    std::array<InputEvent, 4> out;
    CHECK(lines.wait(out, 4000000000U) == 0);
    CHECK(fake_chip.waited_ns == 4000000000000U);
    // As 1.x delivers them, line by line.
    fake_chip.events = {{0, true, 30, 0}, {0, false, 50, 0}, {1, true, 10, 2}, {1, false, 30, 0}};
    REQUIRE(lines.wait(out, 0) == 4);
    CHECK(out[0].time_ns == 10);
    CHECK(out[0].line == 1);
    CHECK(out[0].missed == 2);
    CHECK(out[1].line == 0); // at the same time: as they came
    CHECK(out[2].line == 1);
    CHECK(out[2].time_ns == 30);
    CHECK(out[3].time_ns == 50);
    CHECK(lines.wait(std::span(out).first(2), 0) == 2);
    CHECK(lines.wait({}, 0) == -1);
    CHECK(errno == EINVAL);
    fake_chip.wait_error = EINTR;
    CHECK(lines.wait(out, 0) == 0);
    fake_chip.wait_error = ENODEV;
    CHECK(lines.wait(out, 0) == -1);
    CHECK(errno == ENODEV);
}
TEST_CASE("A signal that ends the program makes the lines safe first, one that somebody handles does not") {
    const auto handler = [](int signal) {
        struct sigaction action {};
        REQUIRE(sigaction(signal, nullptr, &action) == 0);
        return action.sa_handler;
    };
    const auto others = +[](int) {
    };
    REQUIRE(std::signal(SIGQUIT, others) != SIG_ERR);
    REQUIRE(std::signal(SIGPIPE, SIG_IGN) != SIG_ERR);
    OutputPins lines("chip", "test", three);
    std::array<OutputPins*, 1> chips{&lines};
    {
        const CrashGuard guard(chips);
        CHECK(handler(SIGQUIT) == others);
        CHECK(handler(SIGPIPE) == SIG_IGN);
        for (const int signal : {SIGALRM, SIGXFSZ, SIGPROF, SIGXCPU}) {
            CHECK(handler(signal) != SIG_DFL);
            const int code = splinefeed_test::exit_of([&] {
                fake_chip.between = [] {
                    _exit(42);
                }; // the write comes
                static_cast<void>(raise(signal));
            });
            CHECK(code == 42);
        }
    }
    CHECK(handler(SIGALRM) == SIG_DFL);
    CHECK(handler(SIGQUIT) == others);
    static_cast<void>(std::signal(SIGQUIT, SIG_DFL));
    static_cast<void>(std::signal(SIGPIPE, SIG_DFL));
}
#endif
