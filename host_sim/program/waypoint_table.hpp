// SPDX-License-Identifier: MIT
// WaypointTable: waypoints in memory, as those of a file. TableRows, PushedRows: its rows, all of them, and as they
// come.
#pragma once

#include "host_sim/program/input_format.hpp"

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace splinefeed::host {

/// Columns that are empty are not there. A NaN in one of the last four is an empty field.
struct WaypointTable {
    std::size_t columns = 0;           ///< numbers a position, of the first axes
    std::vector<double> position_mm{}; ///< of each waypoint, `columns` numbers
    std::vector<double> feed_mm_s{};   ///< of each waypoint; the same below
    std::vector<double> max_feed_mm_s{};
    std::vector<double> tolerance_mm{};
    std::vector<double> corner{}; ///< 1: a corner, 0: none, NaN: the corner angle decides

    [[nodiscard]] std::size_t rows() const noexcept { return columns > 0 ? position_mm.size() / columns : 0; }
};

/// Checks rows as those of a file are checked.
class WaypointCheck {
public:
    /// @param name  of the input, for messages   @param axes  names
    WaypointCheck(std::string name, std::vector<std::string> axes) : name_(std::move(name)), axes_(std::move(axes)) {}

    /// The next row of a table, with its number from 1 as line. Throws InputError.
    [[nodiscard]] WaypointRow row(const WaypointTable& table, std::size_t index);
    /// There are no more rows. Throws InputError where they are no path.
    void finish() const;

private:
    void refuse(std::uint64_t line, const std::string& text) const;

    std::string name_;
    std::vector<std::string> axes_;
    std::optional<WaypointRow> last_;
    std::uint64_t rows_ = 0;
};

class TableRows final : public WaypointRows {
public:
    TableRows(std::shared_ptr<const WaypointTable> table, WaypointCheck check)
        : table_(std::move(table)), check_(std::move(check)) {}

    bool next(WaypointRow& out) override;

private:
    std::shared_ptr<const WaypointTable> table_;
    WaypointCheck check_;
    std::size_t at_ = 0;
};

/// Rows that are pushed while others are taken, by one thread.
class PushedRows final : public WaypointRows {
public:
    explicit PushedRows(WaypointCheck check) : check_(std::move(check)) {}

    /// Throws InputError; the rows before the wrong one are there then.
    void push(const WaypointTable& table);
    void finish();
    /// @pre wait() returns true
    bool next(WaypointRow& out) override;
    [[nodiscard]] bool wait(Patience /*patience*/) override { return !rows_.empty() || finished_; }

private:
    WaypointCheck check_;
    std::deque<WaypointRow> rows_;
    bool finished_ = false;
};

/// A table as an input. Throws InputError where it has more columns than there are axes.
/// @param name  of the input, for messages   @param machine_axes  empty: the rows have the axes that the table has
[[nodiscard]] OpenedRows open_table(const std::shared_ptr<const WaypointTable>& table, const std::string& name,
                                    const std::vector<std::string>& machine_axes);

/// The axes of the rows of a table with so many columns. Throws as open_table().
[[nodiscard]] std::vector<std::string> axes_of_table(std::size_t columns, const std::string& name,
                                                     const std::vector<std::string>& machine_axes);

} // namespace splinefeed::host
