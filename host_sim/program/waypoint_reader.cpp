// SPDX-License-Identifier: MIT
#include "host_sim/program/waypoint_reader.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/base/number_text.hpp"
#include "host_sim/base/plain_text.hpp"
#include "host_sim/base/trimmed_text.hpp"

#include "splinefeed/s0_program/text/text_cursor.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr std::string_view axis_letters = "xyzabc";

std::string lower(std::string_view text) {
    std::string out(text);
    std::ranges::transform(out, out.begin(), lower_case);
    return out;
}

// Cuts the first field off a line; false after the last one.
bool take_field(std::string_view& rest, bool& more, std::string_view& field) {
    if (!more) {
        return false;
    }
    const std::size_t comma = rest.find(',');
    more = comma != std::string_view::npos;
    field = trimmed(rest.substr(0, comma));
    rest = more ? rest.substr(comma + 1) : std::string_view{};
    return true;
}

std::size_t count_fields(std::string_view line) {
    return 1 + static_cast<std::size_t>(std::ranges::count(line, ','));
}

} // namespace

void WaypointReader::refuse(const std::string& text) const {
    if (!text.empty()) {
        throw InputError(file_, line_, text);
    }
}

WaypointReader::WaypointReader(std::istream& input, std::string file, std::vector<std::string> axes,
                               bool drop_absent_axes)
    : source_(input.rdbuf()), file_(std::move(file)), axes_(std::move(axes)), buffer_(std::size_t{1} << 16) {
    std::string_view line;
    if (!next_content(line)) {
        throw InputError(file_, 0, "there is no waypoint; a path needs two rows, like 0,0,0 and 10,5,0");
    }
    if (is_header(line)) {
        read_header(line);
        if (!next_content(line)) {
            throw InputError(file_, 0, "there is no waypoint after the header; a path needs two rows");
        }
    } else {
        assume_columns(line);
    }
    if (drop_absent_axes) {
        this->drop_absent_axes();
    }
    last_.line = line_;
    parse(line, last_);
    pending_ = true;
}

bool WaypointReader::next(WaypointRow& out) {
    if (pending_) {
        pending_ = false;
        out = last_;
        ++rows_;
        return true;
    }
    std::string_view line;
    if (!next_content(line)) {
        if (rows_ < 2) {
            throw InputError(file_, line_, "there is a single waypoint; a path needs two");
        }
        return false;
    }
    WaypointRow row;
    row.line = line_;
    parse(line, row);
    check_move(row);
    out = last_ = row;
    ++rows_;
    return true;
}

// Takes what has arrived, and waits only if that is nothing.
bool WaypointReader::fill() {
    if (begin_ > 0) {
        std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
        end_ -= begin_;
        begin_ = 0;
    }
    try {
        if (std::streambuf::traits_type::eq_int_type(source_->sgetc(), std::streambuf::traits_type::eof())) {
            return false;
        }
        const auto room = static_cast<std::streamsize>(buffer_.size() - end_);
        const std::streamsize arrived = std::clamp<std::streamsize>(source_->in_avail(), 1, room);
        const std::streamsize taken = source_->sgetn(buffer_.data() + end_, arrived);
        end_ += static_cast<std::size_t>(taken);
        return taken > 0;
    } catch (const std::ios_base::failure&) {
        throw InputError(file_, line_, "cannot be read; it must be a file or a pipe");
    }
}

bool WaypointReader::next_line(std::string_view& line) {
    std::size_t searched = 0;
    for (;;) {
        const std::size_t length = end_ - begin_;
        const char* const start = buffer_.data() + begin_;
        const void* const found = length > searched ? std::memchr(start + searched, '\n', length - searched) : nullptr;
        const std::size_t size =
            found != nullptr ? static_cast<std::size_t>(static_cast<const char*>(found) - start) : length;
        if (size > longest_line) {
            ++line_;
            throw InputError(file_, line_, "the line is longer than {} bytes; write one waypoint a line", longest_line);
        }
        if (found != nullptr || (ended_ && length > 0)) {
            ++line_;
            line = {start, size};
            begin_ += found != nullptr ? size + 1 : size;
            break;
        }
        if (ended_) {
            return false;
        }
        searched = length;
        ended_ = !fill();
    }
    line = plain_line(line, file_, line_, ended_ && begin_ == end_);
    return true;
}

// The next line that is neither blank nor a comment.
bool WaypointReader::next_content(std::string_view& line) {
    while (next_line(line)) {
        line = trimmed(line);
        if (!line.empty() && line.front() != '#') {
            return true;
        }
    }
    return false;
}

// A header has a letter first and no number anywhere.
bool WaypointReader::is_header(std::string_view line) {
    std::string_view field;
    bool more = true;
    bool first = true;
    while (take_field(line, more, field)) {
        const char initial = field.empty() ? ' ' : static_cast<char>(field.front() | 0x20);
        if (first && (initial < 'a' || initial > 'z')) {
            return false;
        }
        first = false;
        double ignored = 0.0;
        if (read_number(field, ignored) != NumberText::not_a_number) {
            return false;
        }
    }
    return true;
}

int WaypointReader::axis_index(std::string_view name) const {
    const auto found = std::ranges::find(axes_, name);
    return found != axes_.end() ? static_cast<int>(found - axes_.begin()) : no_column;
}

std::string WaypointReader::column_name(int column) const {
    return column == feed_column        ? "feed"
           : column == max_feed_column  ? "max_feed"
           : column == corner_column    ? "corner"
           : column == tolerance_column ? "tolerance"
                                        : axes_[static_cast<std::size_t>(column)];
}

void WaypointReader::read_header(std::string_view line) {
    std::vector<std::string_view> known(axes_.begin(), axes_.end());
    known.insert(known.end(), {"feed", "max_feed", "corner", "tolerance"});
    std::string_view field;
    bool more = true;
    bool has_axis = false;
    while (take_field(line, more, field)) {
        const std::string name = lower(field);
        const int column = name == "feed"        ? feed_column
                           : name == "max_feed"  ? max_feed_column
                           : name == "corner"    ? corner_column
                           : name == "tolerance" ? tolerance_column
                                                 : axis_index(name);
        if (column == no_column) {
            if (name.size() == 1 && axis_letters.find(name.front()) != std::string_view::npos) {
                throw InputError(file_, line_, "there is a column {}, but the machine has no such axis; it has {}",
                                 name, fmt::join(axes_, ", "));
            }
            if (name.find_first_of(";\t |") != std::string::npos) {
                throw InputError(file_, line_, "{} is no name of a column; write commas between the names, like x,y,z",
                                 in_quotes(field));
            }
            const std::string_view near = nearest_name(name, known);
            throw InputError(file_, line_, "unknown column {}; a waypoint file has {}{}", in_quotes(field),
                             listed(known), near.empty() ? "" : fmt::format("; did you mean '{}'?", near));
        }
        if (std::ranges::find(columns_, column) != columns_.end()) {
            throw InputError(file_, line_, "there are two columns {}; name each once", column_name(column));
        }
        has_axis = has_axis || column >= 0;
        columns_.push_back(column);
    }
    if (!has_axis) {
        throw InputError(file_, line_, "there is no column of an axis; name at least one of {}",
                         fmt::join(axes_, ", "));
    }
}

bool WaypointReader::has_tolerances() const noexcept {
    return std::ranges::find(columns_, tolerance_column) != columns_.end();
}

// Without a header the columns are x,y[,z[,a,b,c]].
void WaypointReader::assume_columns(std::string_view line) {
    const std::size_t count = count_fields(line);
    const std::size_t most = std::min(axes_.size(), axis_letters.size());
    const std::size_t fewest = std::min<std::size_t>(2, most);
    if (count < fewest || count > most) {
        double ignored = 0.0;
        if (count == 1 && read_number(line, ignored) == NumberText::not_a_number) {
            throw InputError(file_, line_,
                             "{} is no waypoint; write the coordinates with commas between them, like 10,5,0",
                             in_quotes(line));
        }
        throw InputError(file_, line_,
                         fewest == most
                             ? fmt::format("there are {} columns, and the machine has one axis: {}", count, axes_[0])
                             : fmt::format("there are {} columns and no header; without one there must be {} to {}: {}",
                                           count, fewest, most, fmt::join(axes_, ",")));
    }
    for (std::size_t i = 0; i < count; ++i) {
        const int column = axis_index(axis_letters.substr(i, 1));
        if (column < 0) {
            throw InputError(
                file_, line_,
                "without a header the columns are x,y,z,a,b,c, but the machine has no axis {}; name the columns "
                "in a header row",
                axis_letters[i]);
        }
        columns_.push_back(column);
    }
}

void WaypointReader::drop_absent_axes() {
    std::vector<std::string> present;
    std::vector<int> columns = columns_;
    for (std::size_t k = 0; k < axes_.size(); ++k) {
        const auto found = std::ranges::find(columns_, static_cast<int>(k));
        if (found != columns_.end()) {
            columns[static_cast<std::size_t>(found - columns_.begin())] = static_cast<int>(present.size());
            present.push_back(axes_[k]);
        }
    }
    axes_ = std::move(present);
    columns_ = std::move(columns);
}

void WaypointReader::parse(std::string_view line, WaypointRow& row) const {
    std::string_view rest = line;
    std::string_view field;
    bool more = true;
    for (const int column : columns_) {
        if (!take_field(rest, more, field)) {
            more = true; // too few
            break;
        }
        parse_field(field, column, row);
    }
    if (more) {
        const std::size_t count = count_fields(line);
        throw InputError(file_, line_, "the row has {} value{}; there must be {}, one for each column", count,
                         count == 1 ? "" : "s", columns_.size());
    }
}

void WaypointReader::parse_field(std::string_view field, int column, WaypointRow& row) const {
    if (column == corner_column) {
        if (field != "0" && field != "1" && !field.empty()) {
            throw InputError(file_, line_,
                             "corner is {}; it must be 1 (a corner), 0 (none) or empty (the corner angle decides)",
                             in_quotes(field));
        }
        row.corner = field.empty() ? Corner::automatic : field == "1" ? Corner::forced : Corner::forbidden;
        return;
    }
    const bool is_feed = column == feed_column || column == max_feed_column;
    if ((is_feed || column == tolerance_column) && field.empty()) {
        return;
    }
    double value = 0.0;
    const NumberText result = read_number(field, value);
    if (result != NumberText::number) {
        if (const std::string name = lower(field);
            name == "feed" || name == "max_feed" || name == "corner" || name == "tolerance" || axis_index(name) >= 0) {
            throw InputError(file_, line_, "{} is a name where a number must be; only the first row can be a header",
                             in_quotes(field));
        }
        throw InputError(file_, line_, "{} {} {}", column_name(column),
                         field.empty() ? "is empty and" : in_quotes(field), why_no_number(result));
    }
    if (column == tolerance_column) {
        refuse(tolerance_refusal(value, field));
        row.tolerance_mm = value;
        return;
    }
    if (is_feed) {
        refuse(feed_refusal(column_name(column), value, field));
        (column == feed_column ? row.feed_mm_s : row.max_feed_mm_s) = value;
        return;
    }
    refuse(position_refusal(column_name(column), value, field));
    row.position[static_cast<unsigned>(column)] = value;
}

void WaypointReader::check_move(const WaypointRow& row) const {
    for (const int column : columns_) {
        if (column < 0) {
            continue;
        }
        const auto k = static_cast<unsigned>(column);
        refuse(move_refusal(column_name(column), last_.position[k], row.position[k]));
    }
}

} // namespace splinefeed::host
