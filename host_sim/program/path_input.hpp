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
#include "host_sim/program/source_line.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace splinefeed::host {

/// What a path is read from, and how its curve is made.
struct PathArguments {
    std::string input; ///< a path, or "-"
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

struct PointsMethod;

class PathInput {
public:
    /// Opens the input and reads until its axes are known. Throws InputError and UsageError.
    /// @param machine_axes  names; empty: the path has the axes of the input
    PathInput(const PathArguments& arguments, PathUse use, const std::vector<std::string>& machine_axes,
              const PathTolerances& tolerances = {});

    [[nodiscard]] const CurveChoice& choice() const noexcept { return choice_; }
    /// In which the path is planned.
    [[nodiscard]] ScalarKind scalar() const noexcept { return scalar_; }
    /// The curve's name for files and reports.
    [[nodiscard]] std::string_view curve_name() const noexcept {
        return gcode_                   ? "gcode"
               : elements_              ? "elements"
               : file_.segments.empty() ? choice_.method
                                        : std::string_view(file_.method);
    }
    [[nodiscard]] const std::vector<std::string>& axes() const noexcept { return axes_; }
    /// Bezier segments that are executed unchanged: from a curve file, from a description, or computed from all
    /// waypoints. Null: there are waypoints, and the method streams.
    [[nodiscard]] const CurveFile* segments() const noexcept { return file_.segments.empty() ? nullptr : &file_; }
    /// A program of elements. Null: there is none.
    [[nodiscard]] const ElementProgram* elements() const noexcept { return elements_ ? &*elements_ : nullptr; }
    /// A program in G-code. Null: there is none.
    [[nodiscard]] const GcodeSettings* gcode() const noexcept { return gcode_ ? &*gcode_ : nullptr; }
    /// Of a program in G-code: the largest feed of its moves that are no rapids. @param rotary_axes  bit k: axis k
    /// of the machine is rotary
    void limit_feed(double max_feed_mm_s, std::uint32_t rotary_axes) noexcept;
    /// Of a program in G-code: where the machine stands, and its offsets. A place that is not known is taken for 0.
    void begin_at(const MachineState& state);
    /// Of a program in G-code: the machine's spindle and lines, which must outlive this. Call it before anything is
    /// read.
    void use_outputs(const std::optional<SpindleDescription>& spindle, const ProgramLines& lines) noexcept;
    /// Of a program in G-code: wrong lines are left out, and told to `problems` (null: they end the program).
    void collect_problems(std::vector<std::string>* problems) noexcept;
    /// Whether the waypoints are the ends of lines, which the path follows within a tolerance.
    [[nodiscard]] bool lines_within_tolerance() const noexcept { return lines_within_tolerance_; }
    /// Whether the path follows moves within a tolerance: such lines, elements or a program in G-code.
    [[nodiscard]] bool within_tolerance() const noexcept { return gcode_ || elements_ || lines_within_tolerance_; }
    [[nodiscard]] const PathTolerances& tolerances() const noexcept { return tolerances_; }
    /// Number of waypoints from which the segments were computed; 0: none, or not known.
    [[nodiscard]] std::uint64_t points_read() const noexcept { return points_read_; }
    /// Whether rows() can be called again: the input is not a pipe.
    [[nodiscard]] bool repeatable() const noexcept { return repeatable_; }
    /// The waypoints, from the first one. For a real machine a thread reads them ahead. If the input is not repeatable,
    /// call it only once. @pre segments(), elements() and gcode() are null
    [[nodiscard]] std::unique_ptr<WaypointRows> rows();
    /// The same for the lines of a program. @pre gcode() is not null
    [[nodiscard]] std::unique_ptr<SourceLines> lines();
    /// Name for messages.
    [[nodiscard]] const std::string& name() const noexcept { return name_; }

private:
    void open_description(const PathArguments& arguments, PathUse use, const std::vector<std::string>& machine_axes);
    void open_elements(const PathArguments& arguments, const nlohmann::json& document,
                       const std::vector<std::string>& machine_axes);
    void open_gcode(const PathArguments& arguments, PathUse use, const std::vector<std::string>& machine_axes);
    void compute_from_points(const PointsMethod& method, ScalarKind scalar, PathUse use);

    std::string name_;
    std::string path_; // the path that is opened: /dev/stdin for a file that is standard input
    CurveChoice choice_;
    PathTolerances tolerances_;
    CurveFile file_;
    std::optional<ElementProgram> elements_;
    std::optional<GcodeSettings> gcode_;
    const InputFormat* format_;
    std::vector<std::string> machine_axes_;
    std::vector<std::string> axes_;
    std::unique_ptr<WaypointRows> opened_;
    std::uint64_t points_read_ = 0;
    ScalarKind scalar_;
    bool repeatable_ = true;
    bool read_ahead_ = false;
    bool lines_within_tolerance_ = false;
};

} // namespace splinefeed::host
