// SPDX-License-Identifier: MIT
#include "host_sim/program/tool_file.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/text_file.hpp"
#include "host_sim/config/decimal_number.hpp"

#include "splinefeed/s0_program/text/text_cursor.hpp"

#include <charconv>
#include <cmath>

namespace splinefeed::host {

namespace {

constexpr std::size_t largest_table = 1U << 20U;
constexpr double farthest_mm = 1e6;
constexpr std::int32_t largest_tool = 99999;
constexpr std::int32_t largest_orientation = 9;

class ToolLine {
public:
    ToolLine(const std::string& file, std::uint64_t line, std::string_view text)
        : file_(file), line_(line), text_(text) {}

    /// False: there is no tool in the line.
    bool read(std::int32_t& tool, ToolRow& out) {
        tool = -1;
        for (skip(); !text_.empty() && text_.front() != ';'; skip()) {
            const char letter = upper_case(text_.front());
            text_.remove_prefix(1);
            const double value = number(letter);
            if (const std::size_t axis = ToolRow::letters.find(letter); axis != std::string_view::npos) {
                out.offset[axis] = decimal_of(value);
            } else if (letter == 'D') {
                out.diameter = decimal_of(value);
            } else if (letter == 'T') {
                tool = whole(letter, "tool", value, largest_tool);
            } else if (letter == 'Q') {
                out.orientation = whole(letter, "orientation of a tip", value, largest_orientation);
            } else if (std::string_view("PIJ").find(letter) == std::string_view::npos) {
                throw InputError(file_, line_, "'{}' is no letter of a tool; a line is like T1 P1 Z12.5 D6 ;remark",
                                 letter);
            }
            any_ = true;
        }
        if (any_ && tool < 0) {
            throw InputError(file_, line_, "there is no T; a line is like T1 P1 Z12.5 D6 ;remark");
        }
        return any_;
    }

private:
    [[nodiscard]] std::int32_t whole(char letter, std::string_view what, double value, std::int32_t most) const {
        if (!(value >= 0.0 && value <= most) || value != std::floor(value)) {
            throw InputError(file_, line_, "{}{} is no {}; its number is 0 to {}", letter, value, what, most);
        }
        return static_cast<std::int32_t>(value);
    }
    void skip() {
        while (!text_.empty() && (text_.front() == ' ' || text_.front() == '\t' || text_.front() == '\r')) {
            text_.remove_prefix(1);
        }
    }
    double number(char letter) {
        if (!text_.empty() && text_.front() == '+') {
            text_.remove_prefix(1);
        }
        double value = 0.0;
        const auto [end, error] =
            std::from_chars(text_.data(), text_.data() + text_.size(), value, std::chars_format::fixed);
        if (error != std::errc{} || !(std::abs(value) <= farthest_mm)) {
            throw InputError(file_, line_, "a number of at most {} must follow {}", farthest_mm, letter);
        }
        text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
        return value;
    }

    const std::string& file_;
    std::uint64_t line_;
    std::string_view text_;
    bool any_ = false;
};

} // namespace

ToolRows read_tool_file(const std::string& path) {
    const std::string text = read_text_file(path, largest_table);
    ToolRows rows;
    std::uint64_t line = 0;
    for (std::string_view rest = text; !rest.empty();) {
        const std::size_t end = rest.find('\n');
        ToolLine row(path, ++line, rest.substr(0, end));
        std::int32_t tool = 0;
        ToolRow values;
        if (row.read(tool, values) && !rows.emplace(tool, values).second) {
            throw InputError(path, line, "tool {} stands in the file twice; leave one of its lines out", tool);
        }
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    }
    return rows;
}

bool MachineTools::find(std::int32_t tool, ToolOffset& out) const noexcept {
    const auto found = rows_->find(tool);
    if (found == rows_->end()) {
        return false;
    }
    out = {};
    out.diameter = found->second.diameter;
    out.orientation = found->second.orientation;
    for (std::size_t k = 0; k < axes_->size(); ++k) {
        const char letter = upper_case((*axes_)[k].front());
        if (const std::size_t at = ToolRow::letters.find(letter); at != std::string_view::npos) {
            out.offset[k] = found->second.offset[at];
        }
    }
    return true;
}

} // namespace splinefeed::host
