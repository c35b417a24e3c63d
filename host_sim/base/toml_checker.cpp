// SPDX-License-Identifier: MIT
#include "host_sim/base/toml_checker.hpp"

#include "splinefeed/base/units.hpp"

#include "host_sim/base/nearest_name.hpp"
#include "host_sim/base/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

bool has(const FileTable& table, std::string_view key) {
    return std::ranges::any_of(table.keys, [key](const FileKey& row) { return row.key == key; });
}

} // namespace

void TomlChecker::require_known(const toml::table& table, const FileTable& keys, std::string_view where) const {
    for (const auto& [key, value] : table) {
        const std::string_view name = key.str();
        const std::uint64_t line = key.source().begin.line;
        if (!has(keys, name)) {
            attempt([&] {
                throw InputError(file_, line, "unknown key {} in {}{}", in_quotes(name),
                                 where.empty() ? keys.where : where, in_place_of(name, keys));
            });
        }
    }
}

// A key of another table is in the wrong place; any other may be mistyped.
std::string TomlChecker::in_place_of(std::string_view key, const FileTable& keys) const {
    for (const FileTable* other : elsewhere_) {
        if (has(*other, key)) {
            return fmt::format("; it belongs below {}", other->where);
        }
    }
    std::vector<std::string_view> known;
    for (const FileKey& row : keys.keys) {
        known.push_back(row.key);
    }
    return suggestion(key, known, page_);
}

void TomlChecker::fail_type(const toml::node& node, std::string_view key, std::string_view what) const {
    const auto text = node.value_exact<std::string>();
    double number = 0.0;
    if (text && (*text == "true" || *text == "false" || read_number(*text, number) == NumberText::number)) {
        fail(node, fmt::format("{0} must be {1}, without quotes: {0} = {2}", key, what, *text));
    }
    fail(node, fmt::format("{} must be {}", key, what));
}

std::string TomlChecker::text(const toml::node& node, std::string_view key) const {
    const auto value = node.value_exact<std::string>();
    if (!value || value->empty()) {
        fail(node, fmt::format("{} must be a text in quotes{}", key, value ? ", and not empty" : ""));
    }
    return *value;
}

bool TomlChecker::flag(const toml::node& node, std::string_view key) const {
    const auto value = node.value_exact<bool>();
    if (!value) {
        fail_type(node, key, "true or false");
    }
    return *value;
}

std::optional<std::int64_t> TomlChecker::whole_of(const toml::node& node) {
    const auto number = node.value_exact<double>();
    if (!number) {
        return node.value_exact<std::int64_t>();
    }
    constexpr double beyond = 9223372036854775808.0; // of 64 bits
    return *number == std::trunc(*number) && std::fabs(*number) < beyond
               ? std::optional(static_cast<std::int64_t>(*number))
               : std::nullopt;
}

std::int64_t TomlChecker::whole(const toml::node& node, std::string_view key, WholeRange range) const {
    const auto value = whole_of(node);
    if (!value || *value < range.low || *value > range.high) {
        fail_type(node, key, fmt::format("a whole number from {} to {}", range.low, range.high));
    }
    return *value;
}

double TomlChecker::finite(const toml::node& node, std::string_view key) const {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value)) {
        fail_type(node, key, node.is_number() ? "a finite number" : "a number");
    }
    return *value;
}

double TomlChecker::number(const toml::node& node, std::string_view key, const NumberRange& range) const {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !(*value >= range.low && *value <= range.high)) {
        fail_type(node, key, fmt::format("a number from {} to {} {}", range.low, range.high, range.unit));
    }
    return *value;
}

std::uint32_t TomlChecker::microseconds(const toml::node& node, std::string_view key, const FileKey& row) const {
    return static_cast<std::uint32_t>(std::lround(number(node, key, {row.low, row.high, row.unit}) * us_per_ms));
}

std::size_t TomlChecker::choice(const toml::node& node, std::string_view key,
                                std::span<const std::string_view> names) const {
    const std::string name = text(node, key);
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) {
        fail(node, fmt::format("{} is {}{}", key, in_quotes(name), suggestion(name, names)));
    }
    return static_cast<std::size_t>(found - names.begin());
}

std::vector<std::string> TomlChecker::texts(const toml::node& node, std::string_view key, bool may_be_empty) const {
    const toml::array& list = array(node, key, "a list of texts, like [\"a\", \"b\"]");
    if (list.empty() && !may_be_empty) {
        fail(node, fmt::format("{} must name one at least", key));
    }
    std::vector<std::string> out;
    for (const toml::node& entry : list) {
        out.push_back(text(entry, key));
    }
    return out;
}

const toml::table& TomlChecker::table(const toml::node& node, std::string_view key) const {
    const toml::table* table = node.as_table();
    if (table == nullptr) {
        fail(node, fmt::format("{0} must be a table: [{0}] and its keys below", key));
    }
    return *table;
}

const toml::table* TomlChecker::part(const toml::table& root, const FileTable& keys, std::string_view key) const {
    const toml::node* const node = root.get(key);
    if (node == nullptr) {
        return nullptr;
    }
    require_known(table(*node, key), keys);
    return node->as_table();
}

const toml::array& TomlChecker::array(const toml::node& node, std::string_view key, std::string_view what) const {
    const toml::array* list = node.as_array();
    if (list == nullptr) {
        fail(node, fmt::format("{} must be {}", key, what));
    }
    return *list;
}

std::vector<const toml::table*> TomlChecker::tables(const toml::table& root, std::string_view key) const {
    std::vector<const toml::table*> out;
    const toml::node* node = root.get(key);
    if (node == nullptr) {
        return out;
    }
    const toml::array* list = node->as_array();
    if (list == nullptr) {
        fail(*node, fmt::format("{0} must be tables, each with [[{0}]] above it", key));
    }
    for (const toml::node& entry : *list) {
        const toml::table* table = entry.as_table();
        if (table == nullptr) {
            fail(entry, fmt::format("{0} must be tables, each with [[{0}]] above it", key));
        }
        out.push_back(table);
    }
    return out;
}

const toml::node& TomlChecker::required(const toml::table& table, std::string_view key, std::string_view where,
                                        std::string_view what) const {
    const toml::node* node = table.get(key);
    if (node == nullptr) {
        fail(table, fmt::format("{} has no {}; it must be {}", where, key, what));
    }
    return *node;
}

void TomlChecker::take_ms(const toml::table& table, const FileTable& keys, std::string_view key,
                          std::uint32_t& out_us) const {
    if (const toml::node* node = table.get(key)) {
        out_us = microseconds(*node, key, keys.row(key));
    }
}

} // namespace splinefeed::host
