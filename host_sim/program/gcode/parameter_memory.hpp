// SPDX-License-Identifier: MIT
// ParameterMemory: the parameters of a program, #1 to #5602 and #<name>.
#pragma once

#include "splinefeed/s0_program/text/parameter_table.hpp"

#include <map>
#include <string>
#include <vector>

namespace splinefeed::host {

class ParameterMemory final : public ParameterTable {
public:
    static constexpr std::int32_t largest_number = 5602;
    static constexpr std::size_t most_names = 10'000;

    ParameterMemory() : numbered_(largest_number + 1) {}

    [[nodiscard]] bool read(std::int32_t number, Decimal& out) const noexcept override;
    bool write(std::int32_t number, Decimal value) noexcept override;
    [[nodiscard]] bool read(std::string_view name, Decimal& out) const noexcept override;
    bool write(std::string_view name, Decimal value) noexcept override;
    void forget(std::int32_t number) noexcept override;
    void forget(std::string_view name) noexcept override;

    /// A call begins: #1 to #30 are its arguments, and names without a leading _ are its own.
    void enter(const std::vector<Decimal>& arguments);
    /// It ends: they are again what they were. @pre enter() was called
    void leave();

private:
    static constexpr std::size_t local_numbers = 30;

    struct Value {
        Decimal value{};
        bool set = false;
    };

    using Names = std::map<std::string, Decimal, std::less<>>;
    struct Saved {
        std::vector<Value> numbered;
        Names named;
    };

    std::vector<Value> numbered_;
    Names global_{{"_value", {}}, {"_value_returned", {}}}; // those with a leading _; 0 before any call, as in LinuxCNC
    Names named_;
    std::vector<Saved> callers_;
};

} // namespace splinefeed::host
