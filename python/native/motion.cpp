// SPDX-License-Identifier: MIT
// A planned motion: what `splinefeed plan` computes, kept in memory.
#include "python/native/binding.hpp"
#include "python/native/samples.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/memory_file.hpp"
#include "host_sim/output/summary.hpp"
#include "host_sim/run/kept_motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace splinefeed::python {

namespace {

class Motion {
public:
    /// Plans. @param text  that the arguments read; null: they read a file or an array
    Motion(Machine machine, host::RunArguments arguments, std::shared_ptr<const host::MemoryFile> text)
        : machine_(std::move(machine)), arguments_(std::move(arguments)), text_(std::move(text)),
          kept_(machine_->settings.axes) {
        arguments_.described = *machine_;
        host::RunArguments kept = arguments_;
        kept.motion.kept = &kept_;
        kept.result = &result_;
        static_cast<void>(host::run(kept));
    }

    [[nodiscard]] const host::KeptMotion& kept() const noexcept { return kept_; }
    [[nodiscard]] const host::RunResult& result() const noexcept { return result_; }
    [[nodiscard]] std::size_t axes() const noexcept { return static_cast<std::size_t>(machine_->settings.axes); }

    [[nodiscard]] std::vector<double> mm_per_unit() const {
        std::vector<double> out;
        for (unsigned k = 0; k < axes(); ++k) {
            out.push_back(1.0 / (static_cast<double>(units_per_count) * machine_->settings.axis[k].steps_per_mm));
        }
        return out;
    }

    [[nodiscard]] std::vector<std::string> limit_names() const {
        const std::vector<std::string> names(machine_->axis_name.begin(),
                                             machine_->axis_name.begin() + machine_->settings.axes);
        std::vector<std::string> out;
        for (std::size_t code = 0; code < host::limit_codes; ++code) {
            const host::BindingLimit limit = host::BindingLimit::of(static_cast<std::uint8_t>(code));
            out.push_back(limit.axis < names.size() ? host::limit_name(limit, names) : std::string());
        }
        return out;
    }

    /// Plans once more: what a page shows is not kept.
    void report(const std::string& file) const {
        require_path("the report", file);
        host::RunArguments again = arguments_;
        host::RunResult ignored;
        again.outputs.report = file;
        again.helps = true;
        again.result = &ignored;
        static_cast<void>(host::run(again));
    }

private:
    Machine machine_;
    host::RunArguments arguments_;
    std::shared_ptr<const host::MemoryFile> text_;
    host::KeptMotion kept_;
    host::RunResult result_;
};

std::shared_ptr<Motion> plan_points(const Machine& machine, const Column& points, const std::optional<Column>& feed,
                                    const std::optional<Column>& max_feed, const std::optional<Column>& tolerance,
                                    const std::optional<Column>& corner, const py::dict& options) {
    host::RunArguments arguments = read_options(options, OptionsOf::points);
    arguments.path.name = "points";
    arguments.path.rows.emplace();
    arguments.path.rows->open =
        [table = std::make_shared<const host::WaypointTable>(make_table(points, feed, max_feed, tolerance, corner))](
            const std::string& name, const std::vector<std::string>& axes) {
            return host::open_table(table, name, axes);
        };
    return computed([&] { return std::make_shared<Motion>(machine, std::move(arguments), nullptr); });
}

std::shared_ptr<Motion> plan_program(const Machine& machine, const std::string& format, const std::string& program,
                                     bool is_text, const py::dict& options) {
    host::RunArguments arguments = read_options(options, OptionsOf::program);
    arguments.path.format = host::input_format(format);
    std::shared_ptr<const host::MemoryFile> text;
    if (is_text) {
        text = std::make_shared<const host::MemoryFile>(program);
        arguments.path.name = "program";
    } else {
        require_path("the program", program);
    }
    arguments.path.input = is_text ? text->path() : program;
    return computed([&] { return std::make_shared<Motion>(machine, std::move(arguments), std::move(text)); });
}

py::tuple sample(const Motion& motion, const Column& times) {
    const std::span<const double> all(times.data(), static_cast<std::size_t>(times.size()));
    if (motion.kept().size() == 0) {
        throw py::value_error("the motion has no segment");
    }
    if (!std::all_of(all.begin(), all.end(), [](double t) { return t >= 0.0 && std::isfinite(t); })) {
        throw py::value_error("times must be finite and not negative");
    }
    const auto rows = [&] {
        return py::array_t<double>({all.size(), motion.axes()});
    };
    py::array_t<double> position = rows();
    py::array_t<double> velocity = rows();
    py::array_t<double> acceleration = rows();
    py::array_t<double> jerk = rows();
    const SampleRows out{position.mutable_data(), velocity.mutable_data(), acceleration.mutable_data(),
                         jerk.mutable_data()};
    {
        const py::gil_scoped_release others_run;
        sample_motion(motion.kept(), motion.mm_per_unit(), all, out);
    }
    return py::make_tuple(position, velocity, acceleration, jerk);
}

} // namespace

void bind_motion(py::module_& module) {
    const auto heads = [](const py::object& self) {
        const host::KeptMotion& kept = py::cast<const Motion&>(self).kept();
        return py::array_t<std::uint8_t>({kept.size(), sizeof(host::KeptMotion::Head)},
                                         {kept.record_bytes(), std::size_t{1}},
                                         reinterpret_cast<const std::uint8_t*>(kept.data()), self);
    };
    py::class_<Motion, std::shared_ptr<Motion>>(module, "Motion")
        .def_property_readonly("summary", [](const Motion& motion) { return host::to_json(motion.result().summary); })
        .def_property_readonly("time", [](const Motion& motion) { return motion.result().summary.cycle_time_s; })
        .def_property_readonly("stopped", [](const Motion& motion) { return motion.result().stopped; })
        .def_property_readonly("notes", [](const Motion& motion) { return motion.result().notes; })
        .def_property_readonly("segment_ticks", [](const Motion& motion) { return motion.kept().segment_ticks(); })
        .def_property_readonly("segments", [](const Motion& motion) { return segment_bytes(motion.kept()); })
        .def_property_readonly("heads", heads)
        .def_property_readonly("limit_names", &Motion::limit_names)
        .def("sample", sample)
        .def("report", [](const Motion& motion, const std::string& file) { computed([&] { motion.report(file); }); });
    module.def("plan_points", plan_points);
    module.def("plan_program", plan_program);
}

} // namespace splinefeed::python
