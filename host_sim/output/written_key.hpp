// SPDX-License-Identifier: MIT
// WrittenKey: a key of a JSON object that is written, with its value and what its schema says of it.
#pragma once

#include "host_sim/base/json_schema.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
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
template <class All, class Of, std::size_t n>
[[nodiscard]] nlohmann::ordered_json written_list(const All& all, const WrittenKey<Of> (&keys)[n]) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Of& each : all) {
        list.push_back(written(each, keys));
    }
    return list;
}

[[nodiscard]] inline nlohmann::ordered_json object_schema(nlohmann::ordered_json properties,
                                                          nlohmann::ordered_json required) {
    return {{"type", "object"},
            {"properties", std::move(properties)},
            {"required", std::move(required)},
            {"additionalProperties", false}};
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
    return object_schema(std::move(properties), std::move(required));
}
[[nodiscard]] inline nlohmann::ordered_json list_schema(nlohmann::ordered_json item) {
    return {{"type", "array"}, {"items", std::move(item)}};
}

/// What stands for no value: what is empty, and 0.
template <class Value>
[[nodiscard]] bool is_nothing(const Value& value) {
    if constexpr (requires { *value; }) { // an optional, a pointer
        return !value;
    } else if constexpr (requires { value.empty(); }) {
        return value.empty();
    } else {
        return value == Value{};
    }
}

enum class Nothing : std::uint8_t {
    written, ///< as it is
    null,
    left_out
};

/// A key whose value is `get` of the object: a member, or a function. `write` makes JSON of it, and `inside` is its
/// schema.
template <auto get, auto write, Nothing nothing = Nothing::written>
struct WrittenMember {
    FileKey row;
    nlohmann::ordered_json (*inside)() = nullptr;

    template <class Of>
    constexpr operator WrittenKey<Of>() const { // NOLINT(google-explicit-constructor): rows of a table
        return {row,
                [](const Of& of) {
                    const auto& value = std::invoke(get, of);
                    if constexpr (nothing != Nothing::written) {
                        if (is_nothing(value)) {
                            return nothing == Nothing::null ? nlohmann::ordered_json(nullptr) : left_out();
                        }
                    }
                    if constexpr (requires { *value; }) {
                        return nlohmann::ordered_json(write(*value));
                    } else {
                        return nlohmann::ordered_json(write(value));
                    }
                },
                inside};
    }
};

// Rows of values that are always there.
inline constexpr auto as_it_is = [](const auto& value) -> const auto& {
    return value;
};
constexpr FileKey count_row(std::string_view key, std::string_view sentence) {
    return needed(whole_key(key, 0, std::numeric_limits<double>::infinity(), sentence));
}
template <auto get>
constexpr WrittenMember<get, as_it_is> count(std::string_view key, std::string_view sentence) {
    return {count_row(key, sentence)};
}
template <auto get>
constexpr WrittenMember<get, as_it_is> quantity(std::string_view key, std::string_view unit,
                                                std::string_view sentence) {
    return {needed({.key = key, .kind = KeyKind::number, .sentence = sentence, .unit = unit})};
}
template <auto get>
constexpr WrittenMember<get, as_it_is> text(std::string_view key, std::string_view sentence) {
    return {needed(text_key(key, sentence))};
}
template <auto get>
constexpr WrittenMember<get, as_it_is> flag(std::string_view key, std::string_view sentence) {
    return {needed(flag_key(key, sentence))};
}
/// What JSON schema says of it is `form`.
template <auto get>
constexpr WrittenMember<get, as_it_is> formed(std::string_view key, std::string_view form, std::string_view sentence) {
    return {needed(form_key(key, form, sentence))};
}
/// Numbers of axes below their names.
template <auto get>
constexpr WrittenMember<get, as_it_is> axes(std::string_view key, std::string_view sentence) {
    return formed<get>(key, R"({"type": "object", "additionalProperties": {"type": "number"}})", sentence);
}
/// An object of these keys.
template <auto get, const auto& keys>
constexpr auto object(std::string_view key, std::string_view sentence) {
    constexpr auto write = [](const auto& value) {
        return written(value, keys);
    };
    return WrittenMember<get, write>{needed(form_key(key, "{}", sentence)), [] {
                                         return written_schema(keys);
                                     }};
}
/// A list of such objects.
template <auto get, const auto& keys>
constexpr auto objects(std::string_view key, std::string_view sentence) {
    constexpr auto write = [](const auto& value) {
        return written_list(value, keys);
    };
    return WrittenMember<get, write>{needed(form_key(key, "{}", sentence)), [] {
                                         return list_schema(written_schema(keys));
                                     }};
}
/// JSON that `get` makes.
template <auto get, nlohmann::ordered_json (*schema)()>
constexpr WrittenMember<get, as_it_is> composed(std::string_view key, std::string_view sentence) {
    return {needed(form_key(key, "{}", sentence)), schema};
}
/// What to_json() writes.
template <auto get, nlohmann::ordered_json (*schema)()>
constexpr auto part(std::string_view key, std::string_view sentence) {
    constexpr auto write = [](const auto& value) {
        return to_json(value);
    };
    return WrittenMember<get, write>{needed(form_key(key, "{}", sentence)), schema};
}

/// The same, and null where it is nothing.
template <auto get, auto write>
constexpr WrittenMember<get, write, Nothing::null> or_null(WrittenMember<get, write> of) {
    of.row.nullable = true;
    return {of.row, of.inside};
}
/// The same, and not there where it is nothing.
template <auto get, auto write>
constexpr WrittenMember<get, write, Nothing::left_out> if_any(WrittenMember<get, write> of) {
    of.row.required = false;
    return {of.row, of.inside};
}

} // namespace splinefeed::host
