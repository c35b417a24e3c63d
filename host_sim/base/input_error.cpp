// SPDX-License-Identifier: MIT
#include "host_sim/base/input_error.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

std::string printable(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const unsigned char next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0;
        if (byte < 0x20 || byte == 0x7f) {
            out += fmt::format("\\x{:02x}", byte);
        } else if (byte == 0xc2 && next >= 0x80 && next < 0xa0) { // U+0080 to U+009F, which terminals obey, too
            out += fmt::format("\\x{:02x}", next);
            ++i;
        } else {
            out += text[i];
        }
    }
    return out;
}

std::string in_quotes(std::string_view text) {
    constexpr std::size_t longest = 40;
    const bool cut = text.size() > longest;
    return fmt::format("'{}{}'", printable(text.substr(0, longest)), cut ? "..." : "");
}

InputError::InputError(std::string_view file, std::uint64_t line, std::string_view text)
    : std::runtime_error(printable(file.empty() ? std::string(text)
                                   : line == 0  ? fmt::format("{}: {}", file, text)
                                                : fmt::format("{}:{}: {}", file, line, text))) {}

InputError::InputError(std::string_view file, std::uint64_t line, std::uint64_t column, std::string_view text)
    : std::runtime_error(printable(column == 0 ? fmt::format("{}:{}: {}", file, line, text)
                                               : fmt::format("{}:{}:{}: {}", file, line, column, text))) {}

} // namespace splinefeed::host
