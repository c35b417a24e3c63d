// SPDX-License-Identifier: MIT
// ParameterMemory: the parameters of a program, #1 to #5602 and #<name>.
#pragma once

#include "splinefeed/s0_program/text/numbered_parameters.hpp"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace splinefeed::host {

/// #1 to #33 of a macro; one without a value is vacant.
using MacroLocals = std::array<Decimal, 33>;

class ParameterMemory final : public ParameterTable {
public:
    static constexpr std::int32_t largest_number = 5602;
    static constexpr std::size_t most_names = 10'000;

    ParameterMemory() = default;
    ParameterMemory(const ParameterMemory&) = delete;
    ParameterMemory& operator=(const ParameterMemory&) = delete;

    [[nodiscard]] bool read(std::int32_t number, Decimal& out) const noexcept override {
        return numbered_.read(number, out);
    }
    bool write(std::int32_t number, Decimal value) noexcept override { return numbered_.write(number, value); }
    [[nodiscard]] bool read(std::string_view name, Decimal& out) const noexcept override;
    bool write(std::string_view name, Decimal value) noexcept override;
    void forget(std::int32_t number) noexcept override { numbered_.forget(number); }
    void forget(std::string_view name) noexcept override;

    /// A call begins: #1 to #30 are its arguments, and names without a leading _ are its own.
    void enter(const std::vector<Decimal>& arguments);
    /// The same of a macro: #1 to #33 are its own, and those that are no arguments are vacant.
    void enter_macro(const MacroLocals& arguments);
    /// It ends: they are again what they were. @pre enter() was called
    void leave();
    [[nodiscard]] MacroLocals locals() const noexcept;

private:
    static constexpr std::size_t local_numbers = 30;

    using Names = std::map<std::string, Decimal, std::less<>>;
    void save(std::size_t numbers);

    struct Saved {
        std::vector<Decimal> numbered;
        Names named;
    };

    std::vector<Decimal> values_ = std::vector<Decimal>(largest_number); // of numbered_
    NumberedParameters numbered_{values_};
    Names global_{{"_value", {}}, {"_value_returned", {}}}; // those with a leading _; 0 before any call, as in LinuxCNC
    Names named_;
    std::vector<Saved> callers_;
};

} // namespace splinefeed::host
