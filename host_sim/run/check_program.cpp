// SPDX-License-Identifier: MIT
#include "host_sim/run/check_program.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/standard_output.hpp"
#include "host_sim/output/program_report_text.hpp"
#include "host_sim/planning/machine_limits.hpp"
#include "host_sim/planning/move_sources.hpp"
#include "host_sim/report/run_report.hpp"
#include "host_sim/run/run_machine.hpp"

#include <fmt/format.h>
#include <set>
#include <utility>

namespace splinefeed::host {

namespace {

constexpr std::size_t most_problems = 1000;

/// Every line once: what is wrong with it, and whether its moves stay within the travel.
class Survey {
public:
    /// @param record  gets the moves, too; null: nobody does
    Survey(const MachineDescription& machine, const std::string& file, MotionRecord* record = nullptr)
        : machine_(&machine), file_(&file), record_(record), report_(machine) {}

    void read(PathInput& input) {
        const auto program = move_source(input, ScalarKind::float64, &problems_);
        PerAxis<Position> here{};
        static_cast<void>(program->start(here));
        report_.start(here);
        if (record_ != nullptr) {
            record_->start(here);
        }
        try {
            for (SourceStep step; problems_.size() < most_problems && program->next(step);) {
                if (step.kind == StepKind::move) {
                    require_travel(here, step);
                    report_.move(step.move, step.rapid, step.line);
                    if (record_ != nullptr) {
                        record_->move(step.move, step.rapid, step.line);
                    }
                    here = step.move.to;
                }
            }
        } catch (const InputError& error) { // the rest cannot be read
            problems_.emplace_back(error.what());
        }
    }

    [[nodiscard]] const ProgramReport& report() const noexcept { return report_; }
    [[nodiscard]] const std::vector<std::string>& problems() const noexcept { return problems_; }

private:
    void require_travel(const PerAxis<Position>& from, const SourceStep& step) {
        AxisBox box;
        add_extent(from, step.move, machine_->settings.axes, box);
        for (const unsigned k : indices(machine_->settings.axes)) {
            const auto& travel = machine_->travel[k];
            if (travel && (box.low[k] < travel->low || box.high[k] > travel->high) &&
                outside_.emplace(step.line, k).second) {
                const double end = to_mm(step.move.to[k]);
                const bool below = box.low[k] < travel->low && !(end > travel->high);
                problems_.push_back(
                    fmt::format("{}:{}: axis {} goes to {:.4f} mm, {} the end of its travel at {:.4f} mm", *file_,
                                step.line, machine_->axis_name[k], below ? box.low[k] : box.high[k],
                                below ? "below" : "above", below ? travel->low : travel->high));
            }
        }
    }

    const MachineDescription* machine_;
    const std::string* file_;
    MotionRecord* record_;
    ProgramReport report_;
    std::vector<std::string> problems_;
    std::set<std::pair<std::uint64_t, unsigned>> outside_; // lines and axes that are among the problems
};

} // namespace

int check_program(const RunArguments& arguments) {
    const RunMachine of(arguments.machine, *arguments.path.format);
    const PlanFigures figures = plan_figures(arguments.path.scalar, of.machine);
    PathInput input(arguments.path, PathUse::executed, of.path());
    if (input.gcode() == nullptr) {
        throw UsageError("check takes a program in G-code; for other inputs: splinefeed plan");
    }
    if (!input.repeatable()) {
        throw UsageError("check reads the program twice; give it a file");
    }
    MachineState begins = of.state(arguments.state, arguments.position);
    of.settle_places(begins, arguments.state);
    input.begin_at(begins);
    const auto text = arguments.summary == SummaryKind::json ? check_json : check_text;
    Survey survey(of.machine, input.name());
    survey.read(input);
    if (!survey.problems().empty() && !arguments.outputs.report.empty()) {
        // The program cannot be planned: the page shows it, and what is wrong.
        RunReport page(arguments.outputs.report, of.machine, figures.segment_ticks);
        Survey(of.machine, input.name(), &page.record()).read(input);
        const Summary summary;
        page.write({.program = input.name(),
                    .text_file = arguments.path.input,
                    .unit = "line",
                    .stopped = fmt::format("{}", fmt::join(survey.problems(), "\n")),
                    .summary = &summary});
    }
    if (!survey.problems().empty()) {
        print_whole(text(survey.report(), of.machine, survey.problems(), 0.0), "the report");
        return 1;
    }
    ProgramReport report(of.machine);
    MotionArguments motion_arguments = arguments.motion;
    motion_arguments.enforce = false;
    motion_arguments.quiet = true;
    motion_arguments.report = &report;
    const PathLimits path_limits(of.machine);
    std::optional<RunReport> page;
    if (!arguments.outputs.report.empty()) {
        motion_arguments.record = &page.emplace(arguments.outputs.report, of.machine, figures.segment_ticks).record();
    }
    Outputs outputs(arguments.outputs, input.curve_name(), false, of.machine);
    Motion motion(motion_arguments, of.machine, figures, input, path_limits, outputs);
    const std::string stopped = motion.run(std::nullopt);
    const Summary summary = motion.summary();
    if (page) {
        page->write({.program = input.name(),
                     .text_file = arguments.path.input,
                     .unit = "line",
                     .stopped = stopped,
                     .summary = &summary});
    }
    print_whole(text(report, of.machine,
                     stopped.empty() ? std::vector<std::string>{} : std::vector<std::string>{stopped},
                     summary.cycle_time_s),
                "the report");
    return stopped.empty() ? 0 : 1;
}

} // namespace splinefeed::host
