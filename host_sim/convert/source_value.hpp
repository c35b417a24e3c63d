// SPDX-License-Identifier: MIT
// SourceValue: a value of another controller's file, with the line where it stands.
#pragma once

#include "host_sim/base/toml_checker.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace splinefeed::host {

struct SourceValue {
    std::string name; ///< as the file has it: "$110", "[AXIS_X] MAX_VELOCITY", "M203 X"
    std::string text;
    std::uint64_t line = 0;
};

/// Throws InputError: FILE:LINE, what the value is, and why that is wrong.
[[noreturn]] void refuse_value(const std::string& file, const SourceValue& value, std::string_view why);

/// The value as a number. Throws InputError where it is none.
[[nodiscard]] double source_number(const std::string& file, const SourceValue& value);

/// A number as that of a key of a machine file. Throws InputError where it is outside the key's range.
[[nodiscard]] double in_range(const std::string& file, const SourceValue& value, double number, std::string_view key,
                              const NumberRange& range);

/// As NumberRange of one of axis_numbers. @pre  it is one
[[nodiscard]] NumberRange axis_range(std::string_view key);

} // namespace splinefeed::host
