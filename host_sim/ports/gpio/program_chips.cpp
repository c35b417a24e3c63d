// SPDX-License-Identifier: MIT
#include "host_sim/ports/gpio/program_chips.hpp"

#include "host_sim/ports/gpio/pin_claims.hpp"
#include "host_sim/ports/run_target.hpp"

#include "splinefeed/hal/gpio/crash_guard.hpp"
#include "splinefeed/hal/gpio/input_pins.hpp"

#include <array>
#include <mutex>

namespace splinefeed::host {

namespace {

constexpr const char* line_consumer = "splinefeed";

/// Safe at the end, and if the program crashes.
class GuardedPins final : public hal::gpio::PinWriter {
public:
    explicit GuardedPins(const hal::gpio::ChipPins& chip)
        : claims_(chip), lines_(chip.chip, line_consumer, chip.outputs), chips_{&lines_}, guard_(chips_) {}
    [[nodiscard]] bool set(std::uint64_t mask, std::uint64_t levels) noexcept override {
        const std::lock_guard lock(mutex_);
        return lines_.set(mask, levels);
    }

private:
    PinClaims claims_;
    std::mutex mutex_;
    hal::gpio::OutputPins lines_;
    std::array<hal::gpio::OutputPins*, 1> chips_;
    hal::gpio::CrashGuard guard_;
};

struct ReadPins {
    explicit ReadPins(const hal::gpio::ChipPins& chip) : claims(chip), lines(chip.chip, line_consumer, chip.inputs) {}

    PinClaims claims;
    hal::gpio::InputPins lines;
};

} // namespace

ProgramChips open_program_chips(const ProgramPins& lines) {
    ProgramChips out;
    try {
        for (const hal::gpio::ChipPins& chip : lines.chips) {
            out.writer.push_back(chip.outputs.empty() ? nullptr : std::make_shared<GuardedPins>(chip));
            const auto read = chip.inputs.empty() ? nullptr : std::make_shared<ReadPins>(chip);
            out.source.emplace_back(read, read ? &read->lines : nullptr);
        }
    } catch (const hal::gpio::GpioError& error) {
        throw TargetError(error.what());
    }
    return out;
}

std::string name_of_output(const ProgramPins& lines, hal::gpio::PinBit line) {
    const hal::gpio::ChipPins& chip = lines.chips[line.chip];
    const hal::gpio::PinName& name = chip.outputs[line.bit].line;
    return chip.chip + ' ' + (name.name.empty() ? "line " + std::to_string(*name.offset) : name.name);
}

} // namespace splinefeed::host
