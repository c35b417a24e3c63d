// SPDX-License-Identifier: MIT
// The lines that a program switches, on chips that record, and inputs that act when a test says so.
#pragma once

#include "host_sim/ports/gpio/program_chips.hpp"
#include "recording_writer.hpp"

namespace splinefeed_test {

class SetInputs final : public splinefeed::hal::gpio::InputSource {
public:
    [[nodiscard]] std::optional<std::uint64_t> levels() noexcept override { return now; }
    [[nodiscard]] int wait(std::span<splinefeed::hal::gpio::InputEvent> /*out*/,
                           std::uint32_t /*timeout_us*/) noexcept override {
        return 0;
    }

    std::optional<std::uint64_t> now = 0;
};

struct RecordedChips {
    explicit RecordedChips(const splinefeed::host::ProgramPins& lines) {
        for (const splinefeed::hal::gpio::ChipPins& of : lines.chips) {
            auto writer = std::make_shared<RecordingWriter>();
            writer->begin_with(splinefeed::hal::gpio::safe_levels_of(of.outputs));
            chip.push_back(writer.get());
            all.writer.push_back(writer);
            auto source = std::make_shared<SetInputs>();
            inputs.push_back(source.get());
            all.source.push_back(source);
        }
    }

    splinefeed::host::ProgramChips all;
    std::vector<RecordingWriter*> chip;
    std::vector<SetInputs*> inputs;
};

} // namespace splinefeed_test
