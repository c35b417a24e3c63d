// SPDX-License-Identifier: MIT
// NumberedParameters: a program's parameters #1 to #N in memory of the caller.
#pragma once

#include "splinefeed/s0_program/text/parameter_table.hpp"

#include <span>

namespace splinefeed {

/// It has no names: `#<name>` has no value, and no room. A read or a write takes constant time. As long as it lives the
/// parameters keep their values, also behind the end of a program.
class NumberedParameters final : public ParameterTable {
public:
    /// @param values  of as many parameters, from #1 on; none has a value yet. They must outlive it
    explicit NumberedParameters(std::span<Decimal> values) noexcept;

    [[nodiscard]] bool read(std::int32_t number, Decimal& out) const noexcept override;
    /// @pre the value is within +-Decimal::largest_raw
    bool write(std::int32_t number, Decimal value) noexcept override;
    [[nodiscard]] bool read(std::string_view name, Decimal& out) const noexcept override;
    bool write(std::string_view name, Decimal value) noexcept override;
    void forget(std::int32_t number) noexcept override;
    void forget(std::string_view name) noexcept override;

private:
    [[nodiscard]] bool holds(std::int32_t number) const noexcept {
        return number > 0 && static_cast<std::size_t>(number) <= values_.size();
    }
    [[nodiscard]] Decimal& at(std::int32_t number) const noexcept {
        return values_[static_cast<std::size_t>(number) - 1U];
    }

    std::span<Decimal> values_;
};

} // namespace splinefeed
