// SPDX-License-Identifier: MIT
// Points as they come, planned as far as they are known.
#include "python/native/binding.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/curve/methods/method_table.hpp"
#include "host_sim/planning/path_limits.hpp"
#include "host_sim/run/path_watch.hpp"
#include "host_sim/run/run_machine.hpp"

#include <fmt/format.h>
#include <utility>

namespace splinefeed::python {

namespace {

class Stream {
public:
    Stream(const Machine& machine, const py::dict& options)
        : Stream(machine, read_options(options, OptionsOf::stream)) {}

    /// The first points say how many coordinates all have.
    void push(const host::WaypointTable& table) {
        static_cast<void>(host::axes_of_table(table.columns, input_name_, of_.axes));
        if (columns_.value_or(table.columns) != table.columns) {
            throw host::InputError(
                input_name_, 0,
                fmt::format("these points have {} coordinates; the first ones have {}", table.columns, *columns_));
        }
        columns_ = table.columns;
        if (complete_) {
            throw host::UsageError("nothing can be pushed behind finish()");
        }
        rows_->push(table);
    }

    void finish() {
        rows_->finish();
        complete_ = true;
    }

    /// At most so many segments: what can be planned with the points that are known.
    void next(std::size_t most, bool drain, host::KeptMotion& out) {
        while (out.size() < most) {
            FeedSegment segment;
            state_ = path_->next(segment, drain ? Supply::late : Supply::flows);
            if (state_ == Pull::item) {
                keep(segment, out);
            } else if (state_ != Pull::starved || !read()) {
                break;
            }
        }
        if (out.size() == 0 && state_ == Pull::finished) {
            require_end();
        }
    }

    /// The next segment of standstill while the motion is held. Nothing: it does not stand.
    void stand(host::KeptMotion& out) {
        FeedSegment segment;
        if (path_->stream().stand(segment)) {
            keep(segment, out);
        }
    }

    [[nodiscard]] int axes() const noexcept { return of_.machine.settings.axes; }
    [[nodiscard]] MoveStream& steering() noexcept { return path_->stream(); }
    [[nodiscard]] const char* state() const noexcept {
        switch (state_) {
        case Pull::finished: return "finished";
        case Pull::held: return "held";
        case Pull::item: return "moves";
        default: return "starved";
        }
    }

private:
    Stream(const Machine& machine, host::RunArguments arguments)
        : of_(*machine, false), limits_(of_.machine), watch_(input_name_, {.limits = &limits_}) {
        const host::CurveChoice choice = host::choose_curve(arguments.path.curve);
        if (choice.closed || host::points_method(choice.method) != nullptr) {
            throw host::UsageError(fmt::format("{} needs all points before it begins; take plan()",
                                               choice.closed ? "a closed curve" : choice.method));
        }
        arguments.path.name = input_name_;
        arguments.path.rows.emplace();
        arguments.path.rows->repeatable = false;
        arguments.path.rows->open = [this](const std::string& name, const std::vector<std::string>& machine_axes) {
            auto rows = std::make_unique<host::PushedRows>(host::WaypointCheck(name, machine_axes));
            rows_ = rows.get();
            return host::OpenedRows{std::move(rows), machine_axes, false};
        };
        input_.emplace(arguments.path, host::PathUse::executed, of_.path());
        path_ = host::plan_path(*input_, of_.machine, watch_, arguments.motion.planner);
    }

    /// Gives the curve one more point, if there is one.
    bool read() {
        if (!path_->feeder().wait_for_row({})) {
            return false;
        }
        host::PathFeeder::Pushed ignored;
        static_cast<void>(path_->feeder().more(ignored));
        return true;
    }

    void keep(FeedSegment& segment, host::KeptMotion& out) {
        segment.index = count_++;
        out.add(segment, 0, {});
    }

    void require_end() const {
        if (path_->failure()) {
            std::rethrow_exception(path_->failure());
        }
        if (const Status status = path_->stream().status(); !status.ok()) {
            throw host::InputError(input_name_, 0, describe(status.error()));
        }
    }

    const std::string input_name_ = "points";
    host::RunMachine of_;
    std::optional<std::size_t> columns_;
    host::PathLimits limits_;
    host::PathWatch watch_;
    host::PushedRows* rows_ = nullptr; // of the input
    std::optional<host::PathInput> input_;
    std::unique_ptr<host::PlannedPath> path_;
    Pull state_ = Pull::starved;
    std::uint64_t count_ = 0;
    bool complete_ = false;
};

/// What a call adds.
template <class Call>
py::array kept(const Stream& stream, Call&& call) {
    host::KeptMotion all(stream.axes());
    computed([&] { call(all); });
    return segment_bytes(all, all.size());
}

void push(Stream& stream, const Column& points, const std::optional<Column>& feed,
          const std::optional<Column>& max_feed, const std::optional<Column>& corner) {
    stream.push(make_table(points, feed, max_feed, {}, corner));
}

} // namespace

void bind_stream(py::module_& module) {
    py::class_<Stream>(module, "Stream")
        .def(py::init<const Machine&, const py::dict&>())
        .def("push", push)
        .def("finish", &Stream::finish)
        .def("next",
             [](Stream& stream, std::size_t most, bool drain) {
                 return kept(stream, [&](host::KeptMotion& out) { stream.next(most, drain, out); });
             })
        .def("stand", [](Stream& stream) { return kept(stream, [&](host::KeptMotion& out) { stream.stand(out); }); })
        .def("hold", [](Stream& stream) { stream.steering().hold(); })
        .def("resume", [](Stream& stream) { stream.steering().resume(); })
        .def("abort", [](Stream& stream) { stream.steering().abort(); })
        .def("override",
             [](Stream& stream, double ratio) { stream.steering().override_feed(Fixed::from_double(ratio)); })
        .def_property_readonly("state", &Stream::state);
}

} // namespace splinefeed::python
