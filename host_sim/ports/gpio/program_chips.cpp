// SPDX-License-Identifier: MIT
#include "host_sim/ports/gpio/program_chips.hpp"

#include "host_sim/ports/gpio/line_claims.hpp"
#include "host_sim/ports/run_target.hpp"

#include "splinefeed/hal/gpio/crash_guard.hpp"
#include "splinefeed/hal/gpio/input_lines.hpp"

#include <array>
#include <mutex>

namespace splinefeed::host {

namespace {

constexpr const char* line_consumer = "splinefeed";

/// Safe at the end, and if the program crashes.
class GuardedLines final : public hal::gpio::LineWriter {
public:
    explicit GuardedLines(const hal::gpio::ChipLines& chip)
        : claims_(chip), lines_(chip.chip, line_consumer, chip.outputs), chips_{&lines_}, guard_(chips_) {}
    [[nodiscard]] bool set(std::uint64_t mask, std::uint64_t levels) noexcept override {
        const std::lock_guard lock(mutex_);
        return lines_.set(mask, levels);
    }

private:
    LineClaims claims_;
    std::mutex mutex_;
    hal::gpio::OutputLines lines_;
    std::array<hal::gpio::OutputLines*, 1> chips_;
    hal::gpio::CrashGuard guard_;
};

struct ReadLines {
    explicit ReadLines(const hal::gpio::ChipLines& chip) : claims(chip), lines(chip.chip, line_consumer, chip.inputs) {}

    LineClaims claims;
    hal::gpio::InputLines lines;
};

} // namespace

ProgramChips open_program_chips(const ProgramLines& lines) {
    ProgramChips out;
    try {
        for (const hal::gpio::ChipLines& chip : lines.chips) {
            out.writer.push_back(chip.outputs.empty() ? nullptr : std::make_shared<GuardedLines>(chip));
            const auto read = chip.inputs.empty() ? nullptr : std::make_shared<ReadLines>(chip);
            out.source.emplace_back(read, read ? &read->lines : nullptr);
        }
    } catch (const hal::gpio::GpioError& error) {
        throw TargetError(error.what());
    }
    return out;
}

std::string name_of_output(const ProgramLines& lines, hal::gpio::LineBit line) {
    const hal::gpio::ChipLines& chip = lines.chips[line.chip];
    const hal::gpio::LineName& name = chip.outputs[line.bit].line;
    return chip.chip + ' ' + (name.name.empty() ? "line " + std::to_string(*name.offset) : name.name);
}

} // namespace splinefeed::host
