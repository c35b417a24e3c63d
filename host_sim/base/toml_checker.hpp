// SPDX-License-Identifier: MIT
// TomlChecker: reads values from a TOML file and refuses each wrong value with its line.
#pragma once

#include "host_sim/base/file_key.hpp"
#include "host_sim/base/input_error.hpp"

#include "splinefeed/base/assertion.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <toml++/toml.h>
#include <type_traits>
#include <vector>

namespace splinefeed::host {

/// Integers that a key may hold.
struct WholeRange {
    std::int64_t low = 0;
    std::int64_t high = 0;
};

/// Numbers that a key may hold.
struct NumberRange {
    double low = 0.0;
    double high = 0.0;
    std::string_view unit; ///< for the message: "mm/s"
};

/// Every member throws InputError `FILE:LINE: what is wrong, what would be right`. `where` is used in messages:
/// "[link]".
class TomlChecker {
public:
    /// @param page  of the docs, with all keys: for tables that have many
    /// @param problems  gets what attempt() finds wrong; null: the first problem is thrown
    explicit TomlChecker(const std::string& file, std::string_view page, std::vector<std::string>* problems = nullptr)
        : file_(file), page_(page), problems_(problems) {}

    /// Reads a part that does not depend on others. Where problems are collected, those of other parts are found, too.
    template <class Read>
    void attempt(Read&& read) const {
        try {
            read();
        } catch (const InputError& error) {
            if (problems_ == nullptr) {
                throw;
            }
            problems_->emplace_back(error.what());
        }
    }

    /// Its keys may be written into another table by mistake, and are told to belong there.
    void name_table(const FileTable& table) { elsewhere_.push_back(&table); }

    template <class Node>
    [[noreturn]] void fail(const Node& node, std::string_view what) const {
        throw InputError(file_, node.source().begin.line, what);
    }
    template <class Node, class First, class... Rest>
    [[noreturn]] void fail(const Node& node, fmt::format_string<First, Rest...> what, First&& first,
                           Rest&&... rest) const {
        fail(node, fmt::format(what, std::forward<First>(first), std::forward<Rest>(rest)...));
    }
    template <class... What>
    [[noreturn]] void fail_file(fmt::format_string<What...> what, What&&... values) const {
        throw InputError(file_, 0, fmt::format(what, std::forward<What>(values)...));
    }

    /// Refuses other keys than those. @param where  the table, where it is not that of `keys`
    void require_known(const toml::table& table, const FileTable& keys, std::string_view where = {}) const;

    /// A text that is not empty.
    [[nodiscard]] std::string text(const toml::node& node, std::string_view key) const;
    [[nodiscard]] bool flag(const toml::node& node, std::string_view key) const;
    /// A number without a fraction, also one that is written with a point: 2.0. Nothing: it is none, or does not fit.
    [[nodiscard]] static std::optional<std::int64_t> whole_of(const toml::node& node);
    [[nodiscard]] std::int64_t whole(const toml::node& node, std::string_view key, WholeRange range) const;
    [[nodiscard]] double finite(const toml::node& node, std::string_view key) const;
    [[nodiscard]] double number(const toml::node& node, std::string_view key, const NumberRange& range) const;
    /// Milliseconds, possibly with a fraction, as whole microseconds, in the range of the row.
    [[nodiscard]] std::uint32_t microseconds(const toml::node& node, std::string_view key, const FileKey& row) const;
    /// Index of the name in the list.
    [[nodiscard]] std::size_t choice(const toml::node& node, std::string_view key,
                                     std::span<const std::string_view> names) const;
    /// A list of texts; at least one unless `may_be_empty`.
    [[nodiscard]] std::vector<std::string> texts(const toml::node& node, std::string_view key, bool may_be_empty) const;

    [[nodiscard]] const toml::table& table(const toml::node& node, std::string_view key) const;
    /// The table [key], which has these keys and no others; null: it is not there.
    [[nodiscard]] const toml::table* part(const toml::table& root, const FileTable& keys, std::string_view key) const;
    [[nodiscard]] const toml::array& array(const toml::node& node, std::string_view key, std::string_view what) const;
    /// The tables of [[key]]; empty if the key is not there.
    [[nodiscard]] std::vector<const toml::table*> tables(const toml::table& root, std::string_view key) const;

    [[nodiscard]] const toml::node& required(const toml::table& table, std::string_view key, std::string_view where,
                                             std::string_view what) const;

    // Optional values, as the row of the key says: if the key is not there, `out` stays unchanged.
    template <class Value>
    void take(const toml::table& table, const FileTable& keys, std::string_view key, Value& out) const {
        if (const toml::node* node = table.get(key)) {
            out = value<Value>(*node, keys.row(key));
        }
    }
    /// Of a choice bool is whether it is the second name; other values are the place of the name in the list.
    template <class Value>
    [[nodiscard]] Value value(const toml::node& node, const FileKey& row) const {
        if (row.kind == KeyKind::choice) {
            return static_cast<Value>(choice(node, row.key, row.names));
        }
        if constexpr (std::is_same_v<Value, bool>) {
            return flag(node, row.key);
        } else if constexpr (std::is_floating_point_v<Value>) {
            return static_cast<Value>(number(node, row.key, {row.low, row.high, row.unit}));
        } else {
            return static_cast<Value>(whole(node, row.key, whole_range(row)));
        }
    }
    void take_ms(const toml::table& table, const FileTable& keys, std::string_view key, std::uint32_t& out_us) const;

    [[nodiscard]] static WholeRange whole_range(const FileKey& row) {
        SPLINEFEED_ASSERT(row.kind == KeyKind::whole);
        return {whole_bound(row.low), whole_bound(row.high)};
    }

private:
    [[nodiscard]] std::string in_place_of(std::string_view key, const FileTable& keys) const;
    /// The value is not `what`. A number or a truth value in quotes is told to be written without them.
    [[noreturn]] void fail_type(const toml::node& node, std::string_view key, std::string_view what) const;

    const std::string& file_;
    std::string_view page_;
    std::vector<std::string>* problems_;
    std::vector<const FileTable*> elsewhere_;
};

} // namespace splinefeed::host
