// SPDX-License-Identifier: MIT
#include "host_sim/convert/grbl_listing.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/number_text.hpp"
#include "host_sim/base/trimmed_text.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace splinefeed::host {

namespace {

/// Up to a description. A comma or a blank between digits is of the number, which is none then.
std::string_view value_of(std::string_view text) {
    for (std::size_t at = 0; at < text.size(); ++at) {
        const bool digit_follows = at + 1 < text.size() && text[at + 1] >= '0' && text[at + 1] <= '9';
        const bool splits = text[at] == ' ' || text[at] == ',';
        if ((splits && !digit_follows) || text[at] == '\t' || text[at] == '(' || text[at] == ';') {
            return text.substr(0, at);
        }
    }
    return text;
}

/// Of a line that has one. In some terminals' files text stands before it.
std::optional<std::pair<std::int32_t, std::string_view>> setting_of(std::string_view line) {
    for (std::size_t at = line.find('$'); at != std::string_view::npos; at = line.find('$', at + 1)) {
        const std::string_view behind = line.substr(at + 1);
        const std::size_t digits = std::min(behind.find_first_not_of("0123456789"), behind.size());
        const std::string_view rest = trimmed(behind.substr(digits));
        const auto number = read_whole<std::int32_t>(behind.substr(0, digits), 0, 65535);
        if (number && rest.starts_with('=')) {
            return std::pair(*number, value_of(trimmed(rest.substr(1))));
        }
    }
    return std::nullopt;
}

} // namespace

GrblListing::GrblListing(std::string_view text, const std::string& file) : file_(file) {
    std::uint64_t line = 1;
    for (std::size_t at = 0; at < text.size(); ++line) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        if (const auto setting = setting_of(text.substr(at, end - at))) {
            add(setting->first, {fmt::format("${}", setting->first), std::string(setting->second), line});
        }
        at = end + 1;
    }
    if (settings_.empty()) {
        throw InputError(file_, 0, "there is no line like $110=8000.000; save what the controller answers to $$");
    }
}

void GrblListing::add(std::int32_t number, const SourceValue& setting) {
    if (setting.text.find_first_of(" ,") != std::string::npos) {
        refuse_value(file_, setting, "write its number with a point, and nothing between thousands: 8000.500");
    }
    const auto [place, is_new] = settings_.emplace(number, setting);
    const SourceValue& known = place->second;
    if (!is_new && known.text != setting.text) {
        throw InputError(file_, setting.line, "{} is {}, and {} in line {}; leave in what is true", setting.name,
                         in_quotes(setting.text), in_quotes(known.text), known.line);
    }
}

const SourceValue* GrblListing::find(std::int32_t number) const {
    const auto found = settings_.find(number);
    return found != settings_.end() ? &found->second : nullptr;
}

std::int32_t GrblListing::whole(const SourceValue& setting) const {
    const auto number = read_whole<std::int32_t>(setting.text, 0, 255);
    if (!number) {
        refuse_value(file_, setting, "it must be a whole number from 0 to 255");
    }
    return *number;
}

bool is_grbl_listing(std::string_view text) {
    for (const std::string_view line : split(text, '\n')) {
        const auto setting = setting_of(line);
        if (setting && setting->first >= 100 && setting->first < 140) { // of an axis
            return true;
        }
    }
    return false;
}

} // namespace splinefeed::host
