// SPDX-License-Identifier: MIT
#include "host_sim/config/toml_setting.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/number_text.hpp"
#include "host_sim/base/toml_text.hpp"
#include "host_sim/base/trimmed_text.hpp"
#include "host_sim/config/axis_name.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <sstream>

namespace splinefeed::host {

namespace {

bool is_word(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    });
}

/// A document with the value alone.
toml::table value_of(const std::string& setting, const std::string& text) {
    double ignored = 0.0;
    if (const NumberText read = read_number(text, ignored); read == NumberText::out_of_range) {
        throw UsageError("--set {}: {} {}", in_quotes(setting), text, why_no_number(read));
    }
    try {
        if (toml::table document = parse_toml("value = " + text + "\n", {}); document.size() == 1) {
            return document;
        }
    } catch (const InputError&) {
        if (is_word(text)) {
            return parse_toml("value = \"" + text + "\"\n", {});
        }
    }
    throw UsageError("--set {}: {} is no value; it must be a number, true, false, a word, a text in "
                     "quotes or a list",
                     in_quotes(setting), in_quotes(text));
}

toml::table& axis_of(toml::table& document, const std::string& setting, std::string_view name) {
    std::vector<std::string> names;
    if (toml::array* const axes = document.get_as<toml::array>("axis")) {
        for (toml::node& node : *axes) {
            toml::table* const axis = node.as_table();
            names.push_back(axis_name_of(axis != nullptr ? (*axis)["name"].value_or(std::string()) : std::string()));
            if (axis != nullptr && names.back() == axis_name_of(name)) {
                return *axis;
            }
        }
    }
    throw UsageError("--set {}: the machine has no axis {}; it has {}", in_quotes(setting), in_quotes(name),
                     fmt::join(names, ", "));
}

/// The table that has the last part of a name.
toml::table& table_for(toml::table& document, const std::string& setting, const std::vector<std::string_view>& parts) {
    if (parts.size() == 3 && parts[0] == "axis") {
        return axis_of(document, setting, parts[1]);
    }
    if (parts.size() == 1) {
        return document;
    }
    toml::node* const node = document.get(parts[0]);
    if (node != nullptr && node->as_table() == nullptr) {
        throw UsageError("--set {}: {} is no table; a name is KEY, TABLE.KEY or axis.NAME.KEY", in_quotes(setting),
                         in_quotes(parts[0]));
    }
    return node != nullptr ? *node->as_table()
                           : *document.insert_or_assign(parts[0], toml::table{}).first->second.as_table();
}

} // namespace

void apply_setting(toml::table& document, const std::string& setting) {
    const std::size_t equals = setting.find('=');
    const std::vector<std::string_view> parts = split(std::string_view(setting).substr(0, equals), '.');
    const bool named = std::ranges::all_of(parts, is_word);
    if (equals == std::string::npos || !named || parts.size() > 3 || (parts.size() == 3 && parts[0] != "axis")) {
        throw UsageError("--set {}: write KEY=VALUE, TABLE.KEY=VALUE or axis.NAME.KEY=VALUE, like "
                         "axis.x.max_jerk_mm_s3=30000",
                         in_quotes(setting));
    }
    toml::table value = value_of(setting, setting.substr(equals + 1));
    toml::table& table = table_for(document, setting, parts);
    value.get("value")->visit([&](auto& node) { table.insert_or_assign(parts.back(), std::move(node)); });
}

std::string with_settings(std::string_view text, const std::string& file, const std::vector<std::string>& settings) {
    toml::table document = parse_toml(text, file);
    for (const std::string& setting : settings) {
        apply_setting(document, setting);
    }
    std::ostringstream out;
    out << document << '\n';
    return out.str();
}

} // namespace splinefeed::host
