// SPDX-License-Identifier: MIT
// ProgramParameters: the parameters of a G-code program, with a scope for each call of a subroutine.
#pragma once

#include "splinefeed/s0_program/parameter_table.hpp"

#include <map>
#include <string>
#include <vector>

namespace splinefeed::host {

/// #1 to #30 and names without a leading _ belong to the call; others to the program.
class ProgramParameters final : public ParameterTable {
public:
    static constexpr std::int32_t local_numbers = 30;

    ProgramParameters() : calls_(1) {}

    [[nodiscard]] bool read(std::int32_t number, Decimal& out) const noexcept override;
    bool write(std::int32_t number, Decimal value) noexcept override;
    [[nodiscard]] bool read(std::string_view name, Decimal& out) const noexcept override;
    bool write(std::string_view name, Decimal value) noexcept override;

    /// A call begins with its arguments as #1, #2, ...; the others of #1 to #30 are 0.
    void enter(const std::vector<Decimal>& arguments);
    void leave();
    /// Calls within calls; 0: the program itself.
    [[nodiscard]] std::size_t depth() const noexcept { return calls_.size() - 1; }

private:
    struct Scope {
        std::map<std::int32_t, Decimal> numbers;
        std::map<std::string, Decimal> names;
    };

    [[nodiscard]] const Scope& scope_of(std::int32_t number) const noexcept;
    [[nodiscard]] const Scope& scope_of(const std::string& name) const noexcept;

    Scope program_;
    std::vector<Scope> calls_;
};

} // namespace splinefeed::host
