// SPDX-License-Identifier: MIT
// line_keys: how machine and map files name a line of a GPIO chip.
#pragma once

#include "host_sim/base/file_key.hpp"

namespace splinefeed::host {

inline constexpr std::string_view line_levels[] = {"low", "high"};
inline constexpr std::string_view line_biases[] = {"as-is", "disabled", "pull-up", "pull-down"};

inline constexpr double longest_line_name = 31; // the kernel has 32 bytes, with a zero

constexpr FileKey of_a_line_name(FileKey row) {
    row.high = longest_line_name;
    return row;
}
inline constexpr FileKey line_keys[] = {
    form_key("chip", R"({"type": "string", "pattern": "^(/|label=)."})",
             "The whole path of its chip, like /dev/gpiochip1, or label= and its label."),
    whole_key("offset", 0, 65535, "Its number in the chip."), // the largest chips have about a thousand
    of_a_line_name(text_key("name", "Its name, as gpioinfo shows it.")),
};
inline constexpr FileTable line_table{"a line", line_keys,
                                      R"({"anyOf": [{"required": ["offset"]}, {"required": ["name"]}]})"};

constexpr FileKey line_key(std::string_view key, std::string_view sentence) {
    return table_key(key, line_table, sentence, KeyKind::line);
}
constexpr FileKey level_key(std::string_view key, std::string_view sentence) {
    return choice_key(key, line_levels, sentence);
}
inline constexpr FileKey bias_key =
    choice_key("bias", line_biases, "Resistor of the chip at the line; as-is (default) leaves it as it is.");

} // namespace splinefeed::host
