// SPDX-License-Identifier: MIT
// The module splinefeed._native: what splinefeed/*.py stands on.
#include "python/native/binding.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/output_file.hpp"
#include "host_sim/curve/curve_arguments.hpp"

#include <cstddef>
#include <cstring>
#include <exception>
#include <system_error>

namespace splinefeed::python {

namespace {

unsigned long main_thread = 0;

/// The class of that name, which Python has.
py::object error_class(const char* name) {
    return py::module_::import("splinefeed._errors").attr(name);
}

void translate(std::exception_ptr raised) {
    try {
        std::rethrow_exception(std::move(raised));
    } catch (const PythonRaises&) { // its exception is there
    } catch (const host::InputError& error) {
        PyErr_SetString(error_class("InputError").ptr(), error.what());
    } catch (const host::UsageError& error) {
        PyErr_SetString(error_class("UsageError").ptr(), error.what());
    } catch (const host::OutputError& error) {
        PyErr_SetString(error_class("OutputError").ptr(), error.what());
    } catch (const std::system_error& error) {
        PyErr_SetString(PyExc_OSError, error.what());
    }
}

} // namespace

bool in_main_thread() {
    return PyThread_get_thread_ident() == main_thread;
}

void obey_signals() {
    const py::gil_scoped_acquire in_python;
    if (PyErr_CheckSignals() != 0) {
        throw PythonRaises();
    }
}

py::array segment_bytes(const host::KeptMotion& motion, std::size_t count) {
    const auto axes = static_cast<std::size_t>(motion.axes());
    const std::size_t of_axes = axes * sizeof(std::int64_t);
    py::array_t<std::uint8_t> out({count, segment_record(axes)});
    std::uint8_t* at = out.mutable_data();
    for (std::size_t i = 0; i < count; ++i) {
        const FeedSegment segment = motion.segment(i);
        std::memcpy(at, &segment, offsetof(FeedSegment, start));
        at += offsetof(FeedSegment, start);
        for (const auto* values : {&segment.start, &segment.end, &segment.start_velocity, &segment.end_velocity}) {
            std::memcpy(at, values->data(), of_axes);
            at += of_axes;
        }
    }
    return out;
}

} // namespace splinefeed::python

PYBIND11_MODULE(_native, module) {
    using namespace splinefeed;
    namespace py = pybind11;
    python::main_thread = py::cast<unsigned long>(py::module_::import("threading").attr("main_thread")().attr("ident"));
    py::register_exception_translator(python::translate);
    static_assert(offsetof(FeedSegment, duration_ticks) == 8 && offsetof(FeedSegment, waypoint) == 12 &&
                  offsetof(FeedSegment, start) == 16); // as _motion.segment_dtype has it
    module.attr("version") = SPLINEFEED_VERSION;
    module.attr("units_per_count") = units_per_count;
    module.attr("ticks_per_s") = ticks_per_us * 1'000'000;
    module.attr("curve_names") = py::cast([] {
        std::vector<std::string> names;
        for (const std::string_view name : host::curve_names()) {
            names.emplace_back(name);
        }
        return names;
    }());
    python::bind_machine(module);
    python::bind_motion(module);
    python::bind_curve(module);
    python::bind_stream(module);
}
