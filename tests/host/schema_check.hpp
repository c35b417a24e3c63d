// SPDX-License-Identifier: MIT
// What JSON schema (draft 7) says of a document, for the words that our schemas have. tests/schemas/schemas.py has a
// well-kept library for it, and no readers.
#pragma once

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <stdexcept>
#include <string>

namespace splinefeed_test {

using Json = nlohmann::ordered_json;

[[nodiscard]] bool validates(const Json& value, const Json& schema);

namespace schema_words {

inline bool has_type(const Json& value, const std::string& type) {
    return type == "integer"   ? value.is_number() && std::trunc(value.get<double>()) == value.get<double>()
           : type == "number"  ? value.is_number()
           : type == "string"  ? value.is_string()
           : type == "boolean" ? value.is_boolean()
           : type == "array"   ? value.is_array()
           : type == "object"  ? value.is_object()
                               : type == "null" && value.is_null();
}

inline bool matches(const std::string& text, const std::string& pattern) {
    static std::map<std::string, std::regex> known;
    return std::regex_search(text, known.try_emplace(pattern, pattern).first->second);
}

inline bool has_all(const Json& value, const Json& names) {
    return !value.is_object() ||
           std::all_of(names.begin(), names.end(), [&](const Json& name) { return value.contains(name); });
}

inline auto count_valid(const Json& value, const Json& schemas) {
    return std::count_if(schemas.begin(), schemas.end(), [&](const Json& one) { return validates(value, one); });
}

inline bool members_valid(const Json& value, const Json& schema) {
    static const Json none = Json::object();
    const auto part = [&](const char* word) -> const Json& {
        return schema.contains(word) ? schema[word] : none;
    };
    const Json& known = part("properties");
    for (const auto& [key, member] : value.items()) {
        bool found = known.contains(key);
        if (found && !validates(member, known[key])) {
            return false;
        }
        for (const auto& [pattern, inside] : part("patternProperties").items()) {
            if (matches(key, pattern)) {
                found = true;
                if (!validates(member, inside)) {
                    return false;
                }
            }
        }
        if (!found && schema.contains("additionalProperties") && !validates(member, schema["additionalProperties"])) {
            return false;
        }
    }
    for (const auto& [key, needs] : part("dependencies").items()) {
        if (value.contains(key) && !(needs.is_array() ? has_all(value, needs) : validates(value, needs))) {
            return false;
        }
    }
    return true;
}

inline bool items_valid(const Json& value, const Json& items) {
    for (std::size_t i = 0; i < value.size(); ++i) {
        if (items.is_array() ? i < items.size() && !validates(value[i], items[i]) : !validates(value[i], items)) {
            return false;
        }
    }
    return true;
}

inline std::ptrdiff_t letters(const std::string& text) {
    return std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0U) != 0x80; // not the rest of one
    });
}

/// A bound, by a word that begins with min or max.
inline bool within(const std::string& word, const Json& amount, const Json& bound) {
    return word.rfind("min", 0) == 0 ? amount >= bound : amount <= bound;
}

inline bool word_holds(const Json& value, const Json& schema, const std::string& word, const Json& says) {
    const bool number = value.is_number();
    if (word == "type") {
        return has_type(value, says);
    }
    if (word == "enum") {
        return std::find(says.begin(), says.end(), value) != says.end();
    }
    if (word == "const") {
        return value == says;
    }
    if (word == "minimum" || word == "maximum") {
        return !number || within(word, value, says);
    }
    if (word == "multipleOf") {
        return !number || std::fmod(value.get<double>(), says.get<double>()) == 0.0;
    }
    if (word == "minLength" || word == "maxLength") {
        return !value.is_string() || within(word, letters(value.get<std::string>()), says);
    }
    if (word == "pattern") {
        return !value.is_string() || matches(value.get<std::string>(), says.get<std::string>());
    }
    if (word == "minItems" || word == "maxItems") {
        return !value.is_array() || within(word, value.size(), says);
    }
    if (word == "items") {
        return !value.is_array() || items_valid(value, says);
    }
    if (word == "contains") {
        return !value.is_array() ||
               std::any_of(value.begin(), value.end(), [&](const Json& item) { return validates(item, says); });
    }
    if (word == "required") {
        return has_all(value, says);
    }
    if (word == "anyOf" || word == "oneOf") {
        return word == "anyOf" ? count_valid(value, says) > 0 : count_valid(value, says) == 1;
    }
    if (word == "allOf") {
        return count_valid(value, says) == static_cast<std::ptrdiff_t>(says.size());
    }
    if (word == "not") {
        return !validates(value, says);
    }
    if (word == "if") {
        const char* const then = validates(value, says) ? "then" : "else";
        return !schema.contains(then) || validates(value, schema[then]);
    }
    for (const char* const other :
         {"then", "else", "description", "properties", "patternProperties", "additionalProperties", "dependencies"}) {
        if (word == other) {
            return true;
        }
    }
    throw std::invalid_argument("schema_check.hpp does not know " + word);
}

} // namespace schema_words

inline bool validates(const Json& value, const Json& schema) {
    if (schema.is_boolean()) {
        return schema.get<bool>();
    }
    for (const auto& [word, says] : schema.items()) {
        if (!schema_words::word_holds(value, schema, word, says)) {
            return false;
        }
    }
    return !value.is_object() || schema_words::members_valid(value, schema);
}

} // namespace splinefeed_test
