// SPDX-License-Identifier: MIT
// PathInput: the input of a path: rows of waypoints, from a file or a pipe, Bezier segments, or a program of elements.
#pragma once

#include "host_sim/base/scalar_kind.hpp"
#include "host_sim/config/path_tolerances.hpp"
#include "host_sim/config/state_file.hpp"
#include "host_sim/curve/curve_arguments.hpp"
#include "host_sim/curve/curve_file.hpp"
#include "host_sim/program/element_program.hpp"
#include "host_sim/program/gcode_settings.hpp"
#include "host_sim/program/input_format.hpp"
#include "host_sim/program/left_out_list.hpp"
#include "host_sim/program/source_line.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace splinefeed::host {

/// Waypoints that are in no file.
struct GivenRows {
    /// As InputFormat::open().
    std::function<OpenedRows(const std::string& name, const std::vector<std::string>& machine_axes)> open{};
    bool repeatable = true; ///< open() may be called again
};

/// What a path is read from, and how its curve is made.
struct PathArguments {
    std::string input;               ///< a path, or "-"
    std::string name{};              ///< for messages; empty: `input`
    std::optional<GivenRows> rows{}; ///< in the place of `input`
    const InputFormat* format = input_format("csv");
    CurveArguments curve;
    GcodeArguments gcode;
    ScalarKind scalar = ScalarKind::fixed;
};

enum class PathUse {
    drawn,    ///< not executed: its tangent may jump without a stop
    executed, ///< executed only by the simulated machine
    followed, ///< executed by a real machine: a thread reads its waypoints ahead
};

/// The machine as a path is planned for it. What it refers to must outlive the input.
struct PathMachine {
    std::vector<std::string> axes; ///< names; empty: the path has the axes of the input
    PathTolerances tolerances{};
    double max_feed_mm_s = 0.0;    ///< of a program in G-code: the largest feed of its moves that are no rapids
    std::uint32_t rotary_axes = 0; ///< bit k: axis k is rotary
    const SpindleDescription* spindle = nullptr; ///< null: its file says nothing of one
    const ProgramPins* lines = nullptr;          ///< coolant and outputs; null: it has none
};

struct PointsMethod;

class PathInput {
public:
    /// Opens the input and reads until its axes are known. Throws InputError and UsageError.
    PathInput(const PathArguments& arguments, PathUse use, const PathMachine& machine);

    [[nodiscard]] const CurveChoice& choice() const noexcept { return choice_; }
    /// In which the path is planned.
    [[nodiscard]] ScalarKind scalar() const noexcept { return scalar_; }
    /// The curve's name for files and reports.
    [[nodiscard]] std::string_view curve_name() const noexcept {
        return segments() != nullptr ? std::string_view(segments()->method) : choice_.method;
    }
    [[nodiscard]] const std::vector<std::string>& axes() const noexcept { return axes_; }
    /// Bezier segments that are executed unchanged: from a curve file, from a description, or computed from all
    /// waypoints. Null: there are waypoints, and the method streams.
    [[nodiscard]] const CurveFile* segments() const noexcept { return std::get_if<CurveFile>(&content_); }
    /// A program of elements. Null: there is none.
    [[nodiscard]] const ElementProgram* elements() const noexcept { return std::get_if<ElementProgram>(&content_); }
    /// A program in G-code. Null: there is none.
    [[nodiscard]] const GcodeSettings* gcode() const noexcept { return std::get_if<GcodeSettings>(&content_); }
    /// Of a program in G-code: where the machine stands, and its offsets. A place that is not known is taken for 0.
    void begin_at(const MachineState& state);
    /// Of a program in G-code: only so many moves are read.
    void end_after(std::uint64_t moves);
    /// Of a program in G-code: what was left out so far, since it was read from its beginning.
    [[nodiscard]] std::vector<LeftOutList::Entry> left_out() const;
    /// The dialect that `--dialect auto` takes and why, one line; else empty.
    [[nodiscard]] const std::string& dialect_choice() const noexcept { return dialect_choice_; }
    /// That choice, and lines that mean something else in another dialect where no option says whose they are.
    [[nodiscard]] std::vector<std::string> dialect_notes() const;
    /// Whether the waypoints are the ends of lines, which the path follows within a tolerance.
    [[nodiscard]] bool lines_within_tolerance() const noexcept {
        const auto* const waypoints = std::get_if<Waypoints>(&content_);
        return waypoints != nullptr && waypoints->within_tolerance;
    }
    /// Whether the path follows moves within a tolerance: such lines, elements or a program in G-code.
    [[nodiscard]] bool within_tolerance() const noexcept {
        return gcode() != nullptr || elements() != nullptr || lines_within_tolerance();
    }
    [[nodiscard]] const PathTolerances& tolerances() const noexcept { return tolerances_; }
    /// Number of waypoints from which the segments were computed; 0: none, or not known.
    [[nodiscard]] std::uint64_t points_read() const noexcept { return points_read_; }
    /// Whether rows() and lines() can be called again: the input is not a pipe, or nothing more is read of it.
    [[nodiscard]] bool repeatable() const noexcept {
        return reopens_ || segments() != nullptr || elements() != nullptr;
    }
    /// Whether another PathInput can read the same: the input is not a pipe.
    [[nodiscard]] bool reopens() const noexcept { return reopens_; }
    /// The path that is opened: of a file that is standard input /dev/stdin. Empty: rows that are in no file.
    [[nodiscard]] const std::string& path() const noexcept { return path_; }
    /// The waypoints, from the first one. For a real machine a thread reads them ahead. If the input is not repeatable,
    /// call it only once. @pre segments(), elements() and gcode() are null
    [[nodiscard]] std::unique_ptr<WaypointRows> rows();
    /// The same for the lines of a program. @pre gcode() is not null
    [[nodiscard]] std::unique_ptr<SourceLines> lines();
    /// Name for messages.
    [[nodiscard]] const std::string& name() const noexcept { return name_; }

private:
    struct Waypoints {
        std::unique_ptr<WaypointRows> opened; // rows() takes it; null: it opens the input again
        bool within_tolerance = false;
    };
    using Content = std::variant<Waypoints, CurveFile, ElementProgram, GcodeSettings>;

    [[nodiscard]] OpenedRows open_rows() const;
    [[nodiscard]] Content open(const PathArguments& arguments, PathUse use, const PathMachine& machine);
    [[nodiscard]] Content open_waypoints(const PathArguments& arguments, PathUse use);
    [[nodiscard]] Content open_description(const PathArguments& arguments, PathUse use);
    [[nodiscard]] ElementProgram open_elements(const PathArguments& arguments, const nlohmann::json& document);
    [[nodiscard]] GcodeSettings open_gcode(const PathArguments& arguments, PathUse use, const PathMachine& machine);
    void guess_dialect(GcodeSettings& out);
    [[nodiscard]] CurveFile compute_from_points(const PointsMethod& method, WaypointRows& rows, PathUse use);

    std::string name_;
    std::string path_;
    std::optional<GivenRows> given_;
    CurveChoice choice_;
    PathTolerances tolerances_;
    const InputFormat* format_;
    std::vector<std::string> machine_axes_;
    std::vector<std::string> axes_;
    std::uint64_t points_read_ = 0;
    ScalarKind scalar_;
    bool reopens_ = true;
    bool read_ahead_ = false;
    std::unique_ptr<LeftOutList> left_out_; // of a program in G-code
    std::string dialect_choice_;
    std::string dialect_doubt_;
    Content content_; // the last one: what opens it writes the members before
};

} // namespace splinefeed::host
