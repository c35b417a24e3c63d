// SPDX-License-Identifier: MIT
// WrittenKey: a key of a JSON object that is written, with its value and what its schema says of it.
#pragma once

#include "host_sim/base/json_schema.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace splinefeed::host {

template <class Of>
struct WrittenKey {
    FileKey row;                                  ///< required: it is always there
    nlohmann::ordered_json (*value)(const Of&);   ///< left_out(): there is no such key
    nlohmann::ordered_json (*inside)() = nullptr; ///< schema of the value; null: that of the row
};

/// Of a key that is not there.
[[nodiscard]] inline nlohmann::ordered_json left_out() {
    return nlohmann::ordered_json(nlohmann::ordered_json::value_t::discarded);
}

template <class Value>
[[nodiscard]] nlohmann::ordered_json or_null(const std::optional<Value>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

template <class Of, std::size_t n>
[[nodiscard]] nlohmann::ordered_json written(const Of& of, const WrittenKey<Of> (&keys)[n]) {
    nlohmann::ordered_json object = nlohmann::ordered_json::object();
    for (const WrittenKey<Of>& key : keys) {
        if (nlohmann::ordered_json value = key.value(of); !value.is_discarded()) {
            object[std::string(key.row.key)] = std::move(value);
        }
    }
    return object;
}

template <class Of, std::size_t n>
[[nodiscard]] nlohmann::ordered_json written_schema(const WrittenKey<Of> (&keys)[n]) {
    nlohmann::ordered_json properties = nlohmann::ordered_json::object();
    nlohmann::ordered_json required = nlohmann::ordered_json::array();
    for (const WrittenKey<Of>& key : keys) {
        const std::string name(key.row.key);
        properties[name] = key.inside != nullptr ? described(key.row, key.inside()) : schema_of(key.row);
        if (key.row.required) {
            required.push_back(name);
        }
    }
    return {{"type", "object"},
            {"properties", std::move(properties)},
            {"required", std::move(required)},
            {"additionalProperties", false}};
}

[[nodiscard]] inline nlohmann::ordered_json list_schema(nlohmann::ordered_json item) {
    return {{"type", "array"}, {"items", std::move(item)}};
}

// Rows of values that are always there.
constexpr FileKey count_row(std::string_view key, std::string_view sentence) {
    constexpr double any = 1e19;
    return needed(whole_key(key, 0, any, sentence));
}
constexpr FileKey number_row(std::string_view key, std::string_view unit, std::string_view sentence) {
    return needed({.key = key, .kind = KeyKind::number, .sentence = sentence, .unit = unit});
}
constexpr FileKey text_row(std::string_view key, std::string_view sentence) {
    return needed(text_key(key, sentence));
}
constexpr FileKey flag_row(std::string_view key, std::string_view sentence) {
    return needed(flag_key(key, sentence));
}
/// Of an object or a list.
constexpr FileKey inside_row(std::string_view key, std::string_view sentence) {
    return needed(form_key(key, "{}", sentence));
}
/// Numbers of axes below their names.
constexpr FileKey axes_row(std::string_view key, std::string_view sentence) {
    return needed(form_key(key, R"({"type": "object", "additionalProperties": {"type": "number"}})", sentence));
}
constexpr FileKey nullable(FileKey row) {
    row.nullable = true;
    return row;
}
constexpr FileKey not_always(FileKey row) {
    row.required = false;
    return row;
}

} // namespace splinefeed::host
