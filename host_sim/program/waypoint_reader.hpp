// SPDX-License-Identifier: MIT
// WaypointReader: reads a waypoint file row by row, as the bytes arrive.
#pragma once

#include "host_sim/program/waypoint_row.hpp"

#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace splinefeed::host {

/// Uses constant memory, and never waits for more than the end of the current line. Every method throws InputError.
///
///     x,y,feed        <- a header names the columns, in any order and case, or
///     0,0,50          <- without one they are x,y[,z[,a,b,c]]
///     # a comment; blank lines are skipped
class WaypointReader {
public:
    static constexpr std::size_t longest_line = 4096; ///< bytes

    /// Reads up to the first row.
    /// @param file  name of the file, for messages
    /// @param axes  the machine's axes, each one of x,y,z,a,b,c
    /// @param drop_absent_axes  positions have only the axes for which the file has columns: see axes()
    WaypointReader(std::istream& input, std::string file, std::vector<std::string> axes, bool drop_absent_axes = false);

    /// Reads the next row; false at the end of the file.
    bool next(WaypointRow& out);

    /// The names of the coordinates of a row's position.
    [[nodiscard]] const std::vector<std::string>& axes() const noexcept { return axes_; }
    /// Whether there is a column of tolerances.
    [[nodiscard]] bool has_tolerances() const noexcept;
    [[nodiscard]] std::uint64_t rows() const noexcept { return rows_; }

private:
    static constexpr int feed_column = -1;
    static constexpr int corner_column = -2;
    static constexpr int max_feed_column = -3;
    static constexpr int tolerance_column = -4;
    static constexpr int no_column = -5;

    bool fill();
    bool next_line(std::string_view& line);
    bool next_content(std::string_view& line);
    void read_header(std::string_view line);
    void assume_columns(std::string_view line);
    void drop_absent_axes();
    [[nodiscard]] static bool is_header(std::string_view line);
    void parse(std::string_view line, WaypointRow& row) const;
    void parse_field(std::string_view field, int column, WaypointRow& row) const;
    void check_move(const WaypointRow& row) const;
    [[nodiscard]] std::string column_name(int column) const;
    [[nodiscard]] int axis_index(std::string_view name) const;
    /// Unless the text is empty.
    void refuse(const std::string& text) const;

    std::streambuf* source_;
    std::string file_;
    std::vector<std::string> axes_;
    std::vector<int> columns_; // index of the axis, or one of the negative values for other columns
    std::vector<char> buffer_;
    std::size_t begin_ = 0;
    std::size_t end_ = 0;
    std::uint64_t line_ = 0;
    std::uint64_t rows_ = 0;
    WaypointRow last_{};
    bool pending_ = false; // the constructor has read the first row
    bool ended_ = false;
};

} // namespace splinefeed::host
