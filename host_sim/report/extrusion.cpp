// SPDX-License-Identifier: MIT
#include "host_sim/report/extrusion.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

namespace splinefeed::host {

double Extrusion::line(std::string_view text) {
    text = text.substr(0, text.find(';'));
    std::optional<double> extruder;
    int code = -1; // of the first G or M word
    char letter = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        i = text[i] == '(' ? std::min(text.find(')', i), text.size() - 1) : i; // a comment
        const char at = static_cast<char>(std::toupper(static_cast<unsigned char>(text[i])));
        double value = 0.0;
        const char* const begin = text.data() + i + 1;
        const bool is_word = (at == 'G' || at == 'M' || at == 'E') &&
                             std::from_chars(begin, text.data() + text.size(), value).ec == std::errc{};
        if (is_word && at == 'E') {
            extruder = value;
        } else if (is_word && letter == 0) {
            letter = at;
            code = static_cast<int>(value);
        }
    }
    if (letter == 'M' ? code == 82 || code == 83 : letter == 'G' && (code == 90 || code == 91)) {
        relative_ = code == 83 || code == 91;
    }
    if (!extruder) {
        return 0.0;
    }
    if (letter == 'G' && code == 92) {
        at_mm_ = *extruder;
    }
    if (letter != 'G' || code < 0 || code > 3) {
        return 0.0;
    }
    const double from_mm = relative_ ? 0.0 : at_mm_;
    at_mm_ = relative_ ? at_mm_ + *extruder : *extruder;
    return std::max(*extruder - from_mm, 0.0);
}

} // namespace splinefeed::host
