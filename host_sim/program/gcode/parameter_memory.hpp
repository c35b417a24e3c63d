// SPDX-License-Identifier: MIT
// ParameterMemory: the parameters of a program, #1 to #5602 and #<name>.
#pragma once

#include "splinefeed/s0_program/parameter_table.hpp"

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

private:
    struct Value {
        Decimal value{};
        bool set = false;
    };

    std::vector<Value> numbered_;
    std::map<std::string, Decimal, std::less<>> named_;
};

} // namespace splinefeed::host
