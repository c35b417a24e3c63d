// SPDX-License-Identifier: MIT
// binding: what the sources of the Python module share.
#pragma once

#include "host_sim/base/interruption.hpp"
#include "host_sim/config/machine_description.hpp"
#include "host_sim/program/waypoint_table.hpp"
#include "host_sim/run/runner.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <string>

namespace splinefeed::python {

namespace py = pybind11;

// What each source adds to the module.
void bind_machine(py::module_& module);
void bind_motion(py::module_& module);
void bind_curve(py::module_& module);
void bind_stream(py::module_& module);

/// A machine as Python holds it; what is planned for it keeps it alive.
using Machine = std::shared_ptr<const host::MachineDescription>;

/// Thrown where Python has an exception to raise already: a signal handler's.
struct PythonRaises {};

/// Whether this is the thread in which Python runs signal handlers.
[[nodiscard]] bool in_main_thread();
/// Runs the handlers of signals that have come. Throws PythonRaises.
void obey_signals();

/// Calls a long computation while other threads of Python run. Ctrl-C ends it.
template <class Work>
auto computed(Work&& work) {
    const bool interruptible = in_main_thread();
    const py::gil_scoped_release others_run;
    std::optional<host::Interruption> interruption;
    if (interruptible) {
        interruption.emplace(obey_signals);
    }
    return work();
}

/// Throws UsageError where a path names no file: where it is empty, or what the command takes for a standard stream.
/// @param what  for the message: "the program"
void require_path(const char* what, const std::string& path);

/// What takes options.
enum class OptionsOf : unsigned { curve = 1, stream = 2, points = 4, program = 8 };

/// Options by the names of the command's, with _ for -; each as it would be typed, a flag as True or False.
/// Throws UsageError for a value, and TypeError for a name that is none of them, or of something else.
[[nodiscard]] host::RunArguments read_options(const py::dict& options, OptionsOf of);

/// Numbers that splinefeed/_arrays.py has checked.
using Column = py::array_t<double, py::array::c_style>;
using Bytes = py::array_t<std::uint8_t, py::array::c_style>;

/// Arrays as a table; columns that are None are not there. Throws ValueError where a column has another length.
[[nodiscard]] host::WaypointTable make_table(const Column& points, const std::optional<Column>& feed_mm_s,
                                             const std::optional<Column>& max_feed_mm_s,
                                             const std::optional<Column>& tolerance_mm,
                                             const std::optional<Column>& corner);

/// Bytes of a segment, as _motion.segment_dtype describes them.
[[nodiscard]] constexpr std::size_t segment_record(std::size_t axes) noexcept {
    return offsetof(FeedSegment, start) + 4 * axes * sizeof(std::int64_t);
}
/// The first segments as rows of bytes. @pre count <= motion.size()
[[nodiscard]] py::array segment_bytes(const host::KeptMotion& motion, std::size_t count);

} // namespace splinefeed::python
