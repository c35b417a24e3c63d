// SPDX-License-Identifier: MIT
#include "host_sim/program/waypoint_table.hpp"

#include "host_sim/base/input_error.hpp"

#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace splinefeed::host {

namespace {

double field(const std::vector<double>& column, std::size_t row) {
    return row < column.size() ? column[row] : std::nan("");
}

std::string shown(double number) {
    return fmt::format("{}", number);
}

} // namespace

void WaypointCheck::refuse(std::uint64_t line, const std::string& text) const {
    if (!text.empty()) {
        throw InputError(name_, line, text);
    }
}

WaypointRow WaypointCheck::row(const WaypointTable& table, std::size_t index) {
    WaypointRow row;
    row.line = rows_ + 1;
    for (unsigned k = 0; k < table.columns; ++k) {
        const double mm = table.position_mm[index * table.columns + k];
        if (!position_representable(mm)) {
            refuse(row.line, position_refusal(axes_[k], mm, shown(mm)));
        }
        if (last_) {
            refuse(row.line, move_refusal(axes_[k], last_->position[k], mm));
        }
        row.position[k] = mm;
    }
    const auto feed = [&](const std::vector<double>& column, std::string_view name, double& out) {
        if (const double mm_s = field(column, index); !std::isnan(mm_s)) {
            refuse(row.line, feed_refusal(name, mm_s, shown(mm_s)));
            out = mm_s;
        }
    };
    feed(table.feed_mm_s, "feed", row.feed_mm_s);
    feed(table.max_feed_mm_s, "max_feed", row.max_feed_mm_s);
    if (const double mm = field(table.tolerance_mm, index); !std::isnan(mm)) {
        refuse(row.line, tolerance_refusal(mm, shown(mm)));
        row.tolerance_mm = mm;
    }
    if (const double corner = field(table.corner, index); !std::isnan(corner)) {
        if (corner != 0.0 && corner != 1.0) {
            refuse(row.line,
                   fmt::format("corner is {}; it must be 1 (a corner), 0 (none) or nan (the corner angle decides)",
                               corner));
        }
        row.corner = corner == 1.0 ? Corner::forced : Corner::forbidden;
    }
    last_ = row;
    ++rows_;
    return row;
}

void WaypointCheck::finish() const {
    if (rows_ < 2) {
        refuse(rows_,
               rows_ == 0 ? "there is no waypoint; a path needs two" : "there is a single waypoint; a path needs two");
    }
}

bool TableRows::next(WaypointRow& out) {
    if (at_ == table_->rows()) {
        check_.finish();
        return false;
    }
    out = check_.row(*table_, at_++);
    return true;
}

void PushedRows::push(const WaypointTable& table) {
    for (std::size_t i = 0; i < table.rows(); ++i) {
        rows_.push_back(check_.row(table, i));
    }
}

void PushedRows::finish() {
    check_.finish();
    finished_ = true;
}

bool PushedRows::next(WaypointRow& out) {
    if (rows_.empty()) {
        return false;
    }
    out = rows_.front();
    rows_.pop_front();
    return true;
}

std::vector<std::string> axes_of_table(std::size_t columns, const std::string& name,
                                       const std::vector<std::string>& machine_axes) {
    const std::vector<std::string>& axes = machine_axes.empty() ? every_axis : machine_axes;
    if (columns == 0 || columns > axes.size()) {
        throw InputError(name, 0, "the points have {} coordinates; there must be 1 to {}: {}", columns, axes.size(),
                         fmt::join(axes, ", "));
    }
    return machine_axes.empty() ? std::vector(axes.begin(), axes.begin() + static_cast<std::ptrdiff_t>(columns)) : axes;
}

OpenedRows open_table(const std::shared_ptr<const WaypointTable>& table, const std::string& name,
                      const std::vector<std::string>& machine_axes) {
    std::vector<std::string> axes = axes_of_table(table->columns, name, machine_axes);
    auto rows = std::make_unique<TableRows>(table, WaypointCheck(name, axes));
    return {std::move(rows), std::move(axes), !table->tolerance_mm.empty()};
}

} // namespace splinefeed::host
