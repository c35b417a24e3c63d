// SPDX-License-Identifier: MIT
#include "host_sim/program/input_format.hpp"

#include "host_sim/base/input_stream.hpp"
#include "host_sim/program/waypoint_reader.hpp"

#include "splinefeed/s0_program/text/text_cursor.hpp"

#include <algorithm>
#include <array>
#include <istream>

namespace splinefeed::host {

namespace {

/// Rows of a file or a pipe, by a reader of its text.
template <class Reader>
class TextRows final : public WaypointRows {
public:
    TextRows(const std::string& path, const std::string& name, const std::vector<std::string>& axes)
        : file_(path, name), reader_(stream_, name, axes.empty() ? every_axis : axes, axes.empty()) {}

    bool next(WaypointRow& out) override { return reader_.next(out); }
    [[nodiscard]] const Reader& reader() const noexcept { return reader_; }

    void stop() noexcept override { file_.stop(); }

private:
    InputStream file_;
    std::istream stream_{&file_};
    Reader reader_;
};

template <class Reader>
OpenedRows open_text(const std::string& path, const std::string& name, const std::vector<std::string>& machine_axes) {
    auto rows = std::make_unique<TextRows<Reader>>(path, name, machine_axes);
    std::vector<std::string> axes = rows->reader().axes();
    const bool has_tolerances = rows->reader().has_tolerances();
    return {std::move(rows), std::move(axes), has_tolerances};
}

/// One row per format: a new one adds its own.
constexpr std::array formats{
    InputFormat{"csv", InputKind::waypoints, " csv ", open_text<WaypointReader>},
    InputFormat{"json", InputKind::curve, " json ", nullptr},
    InputFormat{"gcode", InputKind::gcode, " ngc nc gcode gco gc tap cnc g ", nullptr},
};

} // namespace

const InputFormat* input_format(std::string_view name) noexcept {
    const auto* const format = std::ranges::find(formats, name, &InputFormat::name);
    return format != formats.end() ? format : nullptr;
}

const InputFormat* format_of_suffix(std::string_view suffix) noexcept {
    std::string padded = " ";
    for (const char c : suffix) {
        padded += lower_case(c);
    }
    padded += ' ';
    for (const InputFormat& format : formats) {
        if (suffix.find(' ') == std::string_view::npos && format.suffixes.find(padded) != std::string_view::npos) {
            return &format;
        }
    }
    return nullptr;
}

std::string input_formats(std::string_view between, std::string_view before) {
    std::string names;
    for (const InputFormat& format : formats) {
        names += names.empty() ? "" : between;
        names += before;
        names += format.name;
    }
    return names;
}

} // namespace splinefeed::host
