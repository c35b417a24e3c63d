// SPDX-License-Identifier: MIT
// MacroVariables: the variables of Fanuc's custom macro B that a program without a machine can have.
#pragma once

#include "host_sim/program/gcode/parameter_memory.hpp"

#include "splinefeed/s0_program/block_interpreter.hpp"
#include "splinefeed/s0_program/words/fanuc_words.hpp"

#include <bitset>
#include <optional>

namespace splinefeed::host {

/// #1 to #999 are a ParameterMemory's, but #500 to #999 are refused until the program has set them: the machine has
/// kept what they were. #4001 to #4120 are modes, #5001, #5021 and #5041 ff. positions. Others are refused, and so are
/// axes that are not the same by their number as by their letter (X Y Z A B C). In dialects without macros it is the
/// memory alone.
class MacroVariables final : public ParameterTable {
public:
    /// Both must outlive it.
    /// @param axes  of the machine: x, y, z, ...
    MacroVariables(ParameterMemory& memory, const std::vector<std::string>& axes) : memory_(&memory), axes_(&axes) {}
    /// Before the first line. Both must outlive this. @param words  of the interpreter; null: it has none
    void follow(const BlockInterpreter& control, const FanucWords* words = nullptr) noexcept {
        control_ = &control;
        words_ = words;
    }

    [[nodiscard]] bool read(std::int32_t number, Decimal& out) const noexcept override;
    bool write(std::int32_t number, Decimal value) noexcept override;
    [[nodiscard]] bool read(std::string_view name, Decimal& out) const noexcept override {
        return memory_->read(name, out);
    }
    bool write(std::string_view name, Decimal value) noexcept override { return memory_->write(name, value); }
    void forget(std::int32_t number) noexcept override { memory_->forget(number); }
    void forget(std::string_view name) noexcept override { memory_->forget(name); }
    [[nodiscard]] bool refuses(std::int32_t number, ParameterAccess access, bool owned) const noexcept override;

private:
    static constexpr std::int32_t first_kept = 500;
    static constexpr std::int32_t first_of_control = 1000;

    [[nodiscard]] bool has_macros() const noexcept { return control_ != nullptr && control_->rules().macros; }
    [[nodiscard]] bool has_axis(std::int32_t index) const noexcept;
    [[nodiscard]] bool is_further() const noexcept { return words_ != nullptr && words_->system() != nullptr; }
    [[nodiscard]] std::optional<Decimal> of_control(std::int32_t number) const noexcept;
    [[nodiscard]] std::optional<Decimal> mode(std::int32_t number) const noexcept;
    [[nodiscard]] std::optional<Decimal> position(std::int32_t block, std::int32_t index) const noexcept;

    ParameterMemory* memory_;
    const std::vector<std::string>* axes_;
    const BlockInterpreter* control_ = nullptr;
    const FanucWords* words_ = nullptr;
    std::bitset<first_of_control - first_kept> is_set_; // of #500 to #999: the program has written it
};

} // namespace splinefeed::host
