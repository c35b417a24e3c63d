// SPDX-License-Identifier: MIT
// FileKey: what a key of a file may hold. Readers check values by it, and JSON schemas are made of it.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace splinefeed::host {

enum class KeyKind : std::uint8_t {
    text,    ///< not empty, and not longer than `high`
    flag,    ///< true or false
    whole,   ///< a whole number
    number,  ///< a number, possibly with a fraction
    choice,  ///< one of `names`
    texts,   ///< a list, at least `low` of them
    choices, ///< a list of `names`
    table,   ///< of the keys `inside`
    tables,  ///< a list of such tables, `low` to `high` of them
    by_axis, ///< such a table for each axis, below the axis's name, a small or a capital letter
    line,    ///< a line of a chip: its name, its offset, or such a table with both
    form     ///< what `form` says, in JSON schema
};

struct FileTable;

struct FileKey {
    std::string_view key;
    KeyKind kind = KeyKind::text;
    std::string_view sentence{}; ///< what it is, for people
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    std::string_view unit{};
    std::span<const std::string_view> names{};
    const FileTable* inside = nullptr;
    std::string_view form{};
    bool required = false; ///< in each table; what is required with some other key, the reader says
    bool nullable = false; ///< of what is written: null stands for no value
};

/// The keys of a table, all of them: others are refused.
struct FileTable {
    std::string_view where; ///< for messages: "[link]"
    std::span<const FileKey> keys;
    std::string_view rules; ///< what JSON schema can say of several keys together; a JSON object, or empty

    /// @pre there is such a key
    [[nodiscard]] const FileKey& row(std::string_view key) const;
};

/// The whole number of a row's bound: of 64 bits, whose largest one `double` does not hold.
[[nodiscard]] constexpr std::int64_t whole_bound(double bound) {
    constexpr double beyond = 9223372036854775808.0;
    return bound >= beyond    ? std::numeric_limits<std::int64_t>::max()
           : bound <= -beyond ? std::numeric_limits<std::int64_t>::min()
                              : static_cast<std::int64_t>(bound);
}

// Rows. `sentence` comes last.
constexpr FileKey text_key(std::string_view key, std::string_view sentence) {
    return {.key = key, .kind = KeyKind::text, .sentence = sentence};
}
constexpr FileKey flag_key(std::string_view key, std::string_view sentence) {
    return {.key = key, .kind = KeyKind::flag, .sentence = sentence};
}
constexpr FileKey whole_key(std::string_view key, double low, double high, std::string_view sentence,
                            std::string_view unit = {}) {
    return {.key = key, .kind = KeyKind::whole, .sentence = sentence, .low = low, .high = high, .unit = unit};
}
constexpr FileKey number_key(std::string_view key, double low, double high, std::string_view unit,
                             std::string_view sentence) {
    return {.key = key, .kind = KeyKind::number, .sentence = sentence, .low = low, .high = high, .unit = unit};
}
constexpr FileKey choice_key(std::string_view key, std::span<const std::string_view> names, std::string_view sentence) {
    return {.key = key, .kind = KeyKind::choice, .sentence = sentence, .names = names};
}
constexpr FileKey table_key(std::string_view key, const FileTable& inside, std::string_view sentence,
                            KeyKind kind = KeyKind::table) {
    return {.key = key, .kind = kind, .sentence = sentence, .inside = &inside};
}
constexpr FileKey form_key(std::string_view key, std::string_view form, std::string_view sentence) {
    return {.key = key, .kind = KeyKind::form, .sentence = sentence, .form = form};
}
constexpr FileKey needed(FileKey row) {
    row.required = true;
    return row;
}

} // namespace splinefeed::host
