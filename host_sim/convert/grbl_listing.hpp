// SPDX-License-Identifier: MIT
// GrblListing: what a controller of the grbl family answers to $$.
#pragma once

#include "host_sim/convert/source_value.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace splinefeed::host {

/// Numbers of an axis are that of x and its place here.
inline constexpr std::string_view grbl_axes = "xyzabc";
inline constexpr std::size_t first_rotary_of_grbl = 3;
inline constexpr double per_minute = 60.0; ///< of a velocity

/// Lines like `$110=8000.000`, with whatever a terminal writes before them, and a description behind. Other lines are
/// left out.
class GrblListing {
public:
    /// @param file  of the text, for messages; it must outlive the object. Throws InputError where a number has two
    /// values, or where there is none.
    GrblListing(std::string_view text, const std::string& file);

    /// Null: it is not there.
    [[nodiscard]] const SourceValue* find(std::int32_t number) const;
    [[nodiscard]] const std::map<std::int32_t, SourceValue>& settings() const noexcept { return settings_; }

    /// The number as a key of a machine file. Throws InputError where it is none, or outside the range of the key.
    /// @param factor  the number is the key's times this
    [[nodiscard]] double value(const SourceValue& setting, std::string_view key, const NumberRange& range,
                               double factor = 1.0) const {
        return in_range(file_, setting, source_number(file_, setting) / factor, key, range);
    }
    /// From 0 to 255; throws InputError where it is none of these.
    [[nodiscard]] std::int32_t whole(const SourceValue& setting) const;

private:
    void add(std::int32_t number, const SourceValue& setting);

    const std::string& file_;
    std::map<std::int32_t, SourceValue> settings_;
};

/// Whether a text looks like one.
[[nodiscard]] bool is_grbl_listing(std::string_view text);

} // namespace splinefeed::host
