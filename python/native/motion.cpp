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
#include <cstddef>
#include <cstring>
#include <fmt/format.h>
#include <utility>

namespace splinefeed::python {

namespace {

/// What a motion is planned of. A file is read each time.
class Input {
public:
    Input(Machine machine, host::RunArguments arguments, std::optional<std::string> text)
        : machine_(std::move(machine)), arguments_(std::move(arguments)), text_(std::move(text)) {
        arguments_.described = *machine_;
    }

    [[nodiscard]] const Machine& machine() const noexcept { return machine_; }
    [[nodiscard]] host::RunResult plan(host::KeptMotion& kept) const {
        host::RunArguments arguments = arguments_;
        arguments.motion.kept = &kept;
        return run(arguments);
    }
    void report(const std::string& file) const {
        host::RunArguments arguments = arguments_;
        arguments.outputs.report = file;
        arguments.helps = true;
        static_cast<void>(run(arguments));
    }

private:
    host::RunResult run(host::RunArguments& arguments) const {
        std::optional<host::MemoryFile> file;
        if (text_) {
            file.emplace(*text_);
            arguments.path.input = file->path();
        }
        host::RunResult result;
        arguments.result = &result;
        static_cast<void>(host::run(arguments));
        return result;
    }

    Machine machine_;
    host::RunArguments arguments_;
    std::optional<std::string> text_; // that is read in the place of a file
};

Input input_of_points(const Machine& machine, const Column& points, const std::optional<Column>& feed,
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
    return {machine, std::move(arguments), {}};
}

Input input_of_program(const Machine& machine, const std::string& format, const std::string& program, bool is_text,
                       const py::dict& options) {
    host::RunArguments arguments = read_options(options, OptionsOf::program);
    arguments.path.format = host::input_format(format);
    if (is_text) {
        arguments.path.name = "program";
        return {machine, std::move(arguments), program};
    }
    require_path("the program", program);
    arguments.path.input = program;
    return {machine, std::move(arguments), {}};
}

/// How many numbers BindingLimit::code() can be.

/// A planned motion: its bits, and what is said of it.
struct Motion {
    Machine machine;
    host::KeptMotion kept;
    double time = 0.0;   ///< [s]
    std::string summary; ///< JSON
    std::string stopped;
    std::vector<std::string> notes;

    explicit Motion(const Machine& of) : machine(of), kept(of->settings.axes) {}

    [[nodiscard]] std::size_t axes() const noexcept { return static_cast<std::size_t>(machine->settings.axes); }

    [[nodiscard]] std::vector<double> mm_per_unit() const {
        std::vector<double> out;
        for (unsigned k = 0; k < axes(); ++k) {
            out.push_back(1.0 / (static_cast<double>(units_per_count) * machine->settings.axis[k].steps_per_mm));
        }
        return out;
    }

    [[nodiscard]] std::vector<std::string> limit_names() const {
        const std::vector<std::string> names(machine->axis_name.begin(),
                                             machine->axis_name.begin() + machine->settings.axes);
        std::vector<std::string> out;
        for (std::size_t code = 0; code < host::limit_codes; ++code) {
            const host::BindingLimit limit = host::BindingLimit::of(static_cast<std::uint8_t>(code));
            out.push_back(limit.axis < names.size() ? host::limit_name(limit, names) : std::string());
        }
        return out;
    }
};

std::shared_ptr<Motion> plan(const Input& input) {
    return computed([&] {
        auto motion = std::make_shared<Motion>(input.machine());
        host::RunResult result = input.plan(motion->kept);
        motion->time = result.summary.cycle_time_s;
        motion->summary = host::to_json(result.summary);
        motion->stopped = std::move(result.stopped);
        motion->notes = std::move(result.notes);
        return motion;
    });
}

/// Adds a segment. Throws ValueError where no plan makes one like it.
void add_checked(const FeedSegment& segment, const host::KeptMotion::Head& head, host::KeptMotion& out) {
    bool possible = head.limit < host::limit_codes && segment.duration_ticks > 0;
    for (const unsigned k : indices(out.axes())) {
        std::int64_t distance = 0;
        possible = possible && !__builtin_sub_overflow(segment.end[k], segment.start[k], &distance);
    }
    if (!possible) {
        throw py::value_error(fmt::format("segment {} is none of a plan", out.size()));
    }
    out.add(segment, head.row, host::BindingLimit::of(head.limit));
}

/// A motion of its bits: Motion.first and Motion.records of another one. Throws ValueError where they are none.
std::shared_ptr<Motion> restore_motion(const Machine& machine, const Bytes& first, const Bytes& records, double time,
                                       const std::string& summary, const std::string& stopped,
                                       const std::vector<std::string>& notes) {
    auto motion = std::make_shared<Motion>(machine);
    motion->time = time;
    motion->summary = summary;
    motion->stopped = stopped;
    motion->notes = notes;
    const std::size_t of_axes = motion->axes() * sizeof(std::int64_t);
    const auto record = static_cast<py::ssize_t>(motion->kept.record_bytes());
    const auto size = static_cast<py::ssize_t>(segment_record(motion->axes()));
    if (records.ndim() != 2 || records.shape(1) != record || first.ndim() != 2 || first.shape(1) != size ||
        first.shape(0) != std::min<py::ssize_t>(records.shape(0), 1)) {
        throw py::value_error(fmt::format("its segments are none of {} axes", motion->axes()));
    }
    if (!std::isfinite(time) || time < 0.0) {
        throw py::value_error("its time is none");
    }
    FeedSegment segment;
    if (first.size() > 0) {
        std::memcpy(&segment.index, first.data(), sizeof segment.index);
        std::memcpy(&segment.duration_ticks, first.data() + offsetof(FeedSegment, duration_ticks),
                    sizeof segment.duration_ticks);
        std::memcpy(segment.start.data(), first.data() + offsetof(FeedSegment, start), of_axes);
        std::memcpy(segment.start_velocity.data(), first.data() + offsetof(FeedSegment, start) + 2 * of_axes, of_axes);
    }
    const std::uint8_t* at = records.data();
    for (py::ssize_t i = 0; i < records.shape(0); ++i, at += record) {
        host::KeptMotion::Head head{};
        std::memcpy(&head, at, sizeof head);
        std::memcpy(segment.end.data(), at + sizeof head, of_axes);
        std::memcpy(segment.end_velocity.data(), at + sizeof head + of_axes, of_axes);
        segment.waypoint = head.waypoint;
        add_checked(segment, head, motion->kept);
        segment.start = segment.end;
        segment.start_velocity = segment.end_velocity;
        ++segment.index;
    }
    return motion;
}

py::tuple sample(const Motion& motion, const Column& times) {
    const std::span<const double> all(times.data(), static_cast<std::size_t>(times.size()));
    if (motion.kept.size() == 0) {
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
        sample_motion(motion.kept, motion.mm_per_unit(), all, out);
    }
    return py::make_tuple(position, velocity, acceleration, jerk);
}

} // namespace

void bind_motion(py::module_& module) {
    const auto records = [](const py::object& self) {
        const host::KeptMotion& kept = py::cast<const Motion&>(self).kept;
        return py::array_t<std::uint8_t>({kept.size(), kept.record_bytes()},
                                         reinterpret_cast<const std::uint8_t*>(kept.data()), self);
    };
    py::class_<Input>(module, "Input")
        .def(py::init(&input_of_points))
        .def(py::init(&input_of_program))
        .def("plan", plan)
        .def("report", [](const Input& input, const std::string& file) {
            require_path("the report", file);
            computed([&] { input.report(file); });
        });
    py::class_<Motion, std::shared_ptr<Motion>>(module, "Motion")
        .def_readonly("summary", &Motion::summary)
        .def_readonly("time", &Motion::time)
        .def_readonly("stopped", &Motion::stopped)
        .def_readonly("notes", &Motion::notes)
        .def_property_readonly("segment_ticks", [](const Motion& motion) { return motion.kept.segment_ticks(); })
        .def_property_readonly("segments",
                               [](const Motion& motion) { return segment_bytes(motion.kept, motion.kept.size()); })
        .def_property_readonly("first",
                               [](const Motion& motion) {
                                   return segment_bytes(motion.kept, std::min<std::size_t>(motion.kept.size(), 1));
                               })
        .def_property_readonly("records", records)
        .def_property_readonly("limit_names", &Motion::limit_names)
        .def("sample", sample);
    module.def("restore_motion", restore_motion);
}

} // namespace splinefeed::python
