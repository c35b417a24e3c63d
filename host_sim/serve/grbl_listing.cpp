// SPDX-License-Identifier: MIT
#include "host_sim/serve/grbl_listing.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/number_text.hpp"
#include "host_sim/base/short_number.hpp"
#include "host_sim/base/trimmed_text.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

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
std::optional<GrblSetting> setting_of(std::string_view line, std::uint64_t number_of_line) {
    for (std::size_t at = line.find('$'); at != std::string_view::npos; at = line.find('$', at + 1)) {
        const std::string_view behind = line.substr(at + 1);
        const std::size_t digits = std::min(behind.find_first_not_of("0123456789"), behind.size());
        const std::string_view rest = trimmed(behind.substr(digits));
        const auto number = read_whole<std::int32_t>(behind.substr(0, digits), 0, 65535);
        if (number && rest.starts_with('=')) {
            return GrblSetting{*number, std::string(value_of(trimmed(rest.substr(1)))), number_of_line};
        }
    }
    return std::nullopt;
}

} // namespace

GrblListing::GrblListing(std::string_view text, const std::string& file) : file_(file) {
    std::uint64_t line = 1;
    for (std::size_t at = 0; at < text.size(); ++line) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        if (const std::optional<GrblSetting> setting = setting_of(text.substr(at, end - at), line)) {
            add(*setting);
        }
        at = end + 1;
    }
    if (settings_.empty()) {
        throw InputError(file_, 0, "there is no line like $110=8000.000; save what the controller answers to $$");
    }
}

void GrblListing::add(const GrblSetting& setting) {
    if (setting.value.find_first_of(" ,") != std::string::npos) {
        fail(setting, "write its number with a point, and nothing between thousands: 8000.500");
    }
    const auto [place, is_new] = settings_.emplace(setting.number, setting);
    const GrblSetting& known = place->second;
    if (!is_new && known.value != setting.value) {
        throw InputError(file_, setting.line, "${} is {}, and {} in line {}; leave in what is true", setting.number,
                         in_quotes(setting.value), in_quotes(known.value), known.line);
    }
}

const GrblSetting* GrblListing::find(std::int32_t number) const {
    const auto found = settings_.find(number);
    return found != settings_.end() ? &found->second : nullptr;
}

double GrblListing::value(const GrblSetting& setting, std::string_view key, const NumberRange& range,
                          double factor) const {
    double number = 0.0;
    if (const NumberText read = read_number(setting.value, number); read != NumberText::number) {
        fail(setting, fmt::format("it {}", why_no_number(read)));
    }
    number /= factor;
    if (number < range.low || number > range.high) {
        fail(setting, fmt::format("{} would be {}; it must lie between {} and {} {}", key, short_number(number),
                                  range.low, range.high, range.unit));
    }
    return number;
}

std::int32_t GrblListing::whole(const GrblSetting& setting) const {
    const auto number = read_whole<std::int32_t>(setting.value, 0, 255);
    if (!number) {
        fail(setting, "it must be a whole number from 0 to 255");
    }
    return *number;
}

void GrblListing::fail(const GrblSetting& setting, std::string_view why) const {
    throw InputError(file_, setting.line, "${} is {}: {}", setting.number, in_quotes(setting.value), why);
}

} // namespace splinefeed::host
