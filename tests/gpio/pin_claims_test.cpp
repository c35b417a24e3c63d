// SPDX-License-Identifier: MIT
//
// Who comes second to a line is told who has it: another process says what it gets.
#include "host_sim/ports/gpio/pin_claims.hpp"

#include "support/catch.hpp"

#include <array>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

hal::gpio::ChipPins lines_of(const std::string& output, unsigned input) {
    return {.chip = fmt::format("/dev/no-chip-{}", ::getppid()),
            .outputs = {{.line = {.name = output}}},
            .inputs = {{.line = {.offset = input}}}};
}

std::string refusal(const hal::gpio::ChipPins& chip) {
    try {
        const PinClaims claims(chip);
        return "taken";
    } catch (const hal::gpio::GpioError& error) {
        return error.what();
    }
}

} // namespace

TEST_CASE("a line is that of one program, which is named; the others of its chip are free", "[serve]") {
    std::array<int, 2> asks{};
    std::array<int, 2> answers{};
    REQUIRE(::pipe(asks.data()) == 0);
    REQUIRE(::pipe(answers.data()) == 0);
    hal::gpio::ChipPins chip = lines_of("X_STEP", 4);
    const pid_t child = ::fork();
    if (child == 0) {
        const PinClaims claims(chip);
        char end = 'x';
        const bool told = ::write(answers[1], &end, 1) == 1 && ::read(asks[0], &end, 1) >= 0;
        ::_exit(told ? 0 : 1);
    }
    char ready = ' ';
    REQUIRE(::read(answers[0], &ready, 1) == 1);
    hal::gpio::ChipPins other = chip;
    other.outputs[0].line.name = "Y_STEP";
    const std::string input = refusal(other);
    other.inputs[0].line.offset = 5;
    const std::string free = refusal(other);
    const std::string output = refusal(chip);
    REQUIRE(::write(asks[1], &ready, 1) == 1);
    int status = 1;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(status == 0);
    CHECK(output.rfind("X_STEP of " + chip.chip + ": ", 0) == 0);
    CHECK(output.find(fmt::format("(process {}) uses it; end that first", child)) != std::string::npos);
    CHECK(input.rfind("line 4 of " + chip.chip + ": ", 0) == 0);
    CHECK(free == "taken");
    CHECK(refusal(chip) == "taken");
    for (const int end : {asks[0], asks[1], answers[0], answers[1]}) {
        ::close(end);
    }
}
