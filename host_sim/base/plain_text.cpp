// SPDX-License-Identifier: MIT
#include "host_sim/base/plain_text.hpp"

#include "host_sim/base/input_error.hpp"

#include <algorithm>

namespace splinefeed::host {

namespace {

constexpr char ctrl_z = '\x1a';

std::string_view without_end(std::string_view text, char end) {
    while (!text.empty() && text.back() == end) {
        text.remove_suffix(1);
    }
    return text;
}

// The mark of UTF-8, which editors write, is left out.
std::string_view without_mark(std::string_view text, const std::string& file) {
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
        throw InputError(file, 1, "the text is UTF-16; save it as UTF-8 or ASCII");
    }
    return text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text;
}

[[noreturn]] void fail_nul(const std::string& file, std::uint64_t number) {
    throw InputError(file, number, "the line holds a NUL byte; a text is ASCII or UTF-8, not UTF-16");
}

[[noreturn]] void fail_return(const std::string& file, std::uint64_t number) {
    throw InputError(file, number, "the line holds a CR alone; lines end with \\n or \\r\\n: save the file with these");
}

} // namespace

std::string_view plain_line(std::string_view line, const std::string& file, std::uint64_t number, bool last) {
    line = number == 1 ? without_mark(line, file) : line;
    line = without_end(last ? without_end(line, ctrl_z) : line, '\r');
    if (line.find('\0') != std::string_view::npos) {
        fail_nul(file, number);
    }
    if (line.find('\r') != std::string_view::npos) {
        fail_return(file, number);
    }
    return line;
}

std::string_view plain_text(std::string_view text, const std::string& file) {
    text = without_end(without_mark(text, file), ctrl_z);
    const auto line_of = [&](std::size_t at) {
        return 1 + static_cast<std::uint64_t>(
                       std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
    };
    if (const std::size_t at = text.find('\0'); at < text.size()) {
        fail_nul(file, line_of(at));
    }
    for (std::size_t at = text.find('\r'); at < text.size(); at = text.find('\r', at)) {
        const std::size_t begin = at;
        at = std::min(text.find_first_not_of('\r', at), text.size());
        if (at < text.size() && text[at] != '\n') {
            fail_return(file, line_of(begin));
        }
    }
    return text;
}

} // namespace splinefeed::host
