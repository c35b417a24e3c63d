// SPDX-License-Identifier: MIT
#include "host_sim/run/runner.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/standard_streams.hpp"
#include "host_sim/output/program_report_text.hpp"
#include "host_sim/output/progress.hpp"
#include "host_sim/planning/machine_limits.hpp"
#include "host_sim/planning/move_sources.hpp"
#include "host_sim/run/run_machine.hpp"
#include "host_sim/run/zero_range.hpp"

#include <fmt/format.h>
#include <utility>

namespace splinefeed::host {

namespace {

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
        Progress progress;
        try {
            for (SourceStep step; program->next(step);) {
                if (progress.due()) {
                    progress.show({report_.feeds().moves + report_.rapids().moves, step.line});
                }
                if (step.kind == StepKind::move) {
                    require_travel(here, step);
                    report_.move(step.move, step.rapid, step.line);
                    if (record_ != nullptr) {
                        record_->move(step.move, step.rapid, step.line);
                    }
                    here = step.move.to;
                }
            }
            unread_ = program->unread();
        } catch (const InputError& error) { // the rest cannot be read
            problems_.add(error, 0);
        }
    }

    [[nodiscard]] const ProgramReport& report() const noexcept { return report_; }
    [[nodiscard]] const ProblemList& problems() const noexcept { return problems_; }
    /// Moves outside the travel.
    [[nodiscard]] const ProblemList& outside() const noexcept { return outside_; }
    [[nodiscard]] std::vector<std::string> notes() const {
        if (unread_.lines == 0) {
            return {};
        }
        return {fmt::format("{}:{}: the program ends here; {} line{} behind it {} not read", *file_, unread_.end,
                            unread_.lines, unread_.lines == 1 ? "" : "s", unread_.lines == 1 ? "is" : "are")};
    }

private:
    void require_travel(const PerAxis<Position>& from, const SourceStep& step) {
        AxisBox box;
        add_extent(from, step.move, machine_->settings.axes, box);
        for (const unsigned k : indices(machine_->settings.axes)) {
            const auto& travel = machine_->travel[k];
            if (travel && (box.low[k] < travel->low || box.high[k] > travel->high)) {
                const double end = to_mm(step.move.to[k]);
                const bool below = box.low[k] < travel->low && !(end > travel->high);
                const std::string limit = fmt::format("{} the end of its travel at {:.4f} mm",
                                                      below ? "below" : "above", below ? travel->low : travel->high);
                outside_.add({*file_, step.line,
                              fmt::format("axis {} goes to {:.4f} mm, {}", machine_->axis_name[k],
                                          below ? box.low[k] : box.high[k], limit)},
                             step.line, machine_->axis_name[k] + limit);
            }
        }
    }

    const MachineDescription* machine_;
    const std::string* file_;
    MotionRecord* record_;
    ProgramReport report_;
    ProblemList problems_;
    ProblemList outside_;
    UnreadLines unread_{};
};

/// Where a program leaves the travel, and where its zero has to lie. If nobody has said where that lies, it is one
/// problem.
void add_outside(const RunArguments& arguments, const RunMachine& of, const MachineState& begins, const Survey& survey,
                 ProgramFindings& findings) {
    const ProblemList& outside = survey.outside();
    if (outside.empty()) {
        return;
    }
    const std::vector<ZeroRange> ranges = zero_ranges(arguments.path, of, begins);
    const std::vector<std::string> texts = outside.texts();
    const bool is_told = !arguments.zero.empty() || begins.offsets != WorkOffsets{};
    if (leaves(ranges) && can_fit(ranges) && !is_told) {
        findings.problems.push_back(fmt::format("{}; {}", texts.front(), zero_advice(ranges)));
        ++findings.problem_count;
        return;
    }
    findings.problems.insert(findings.problems.end(), texts.begin(), texts.end());
    findings.problem_count += outside.count();
    if (leaves(ranges)) {
        findings.notes.push_back(fmt::format("{}: {}", printable(arguments.path.input), zero_advice(ranges)));
    }
}

/// The page of a program that cannot be planned: it shows the program, and what is wrong.
void write_problems(const RunArguments& arguments, const MachineDescription& machine, std::uint32_t segment_ticks,
                    PathInput& input, const ProgramFindings& findings, std::vector<Summary::AxisPlace> places) {
    Summary summary;
    summary.places = std::move(places);
    RunReport page(arguments.outputs.report, machine, segment_ticks);
    Survey(machine, input.name(), &page.record()).read(input);
    page.write(report_facts(input, summary, fmt::format("{}", fmt::join(findings.problems, "\n"))));
}

} // namespace

int check_program(const RunArguments& arguments) {
    const RunMachine of(machine_of(arguments), *arguments.path.format);
    tell_note(note_of(machine_of(arguments), of.machine));
    const PlanFigures figures = plan_figures(arguments.path.scalar, of.machine);
    PathInput input(arguments.path, PathUse::executed, of.path());
    if (input.gcode() == nullptr) {
        throw UsageError("check takes a program in G-code; for other inputs: splinefeed plan");
    }
    if (!input.repeatable()) {
        throw UsageError("check reads the program twice; give it a file");
    }
    MachineState begins = of.state(arguments.state, arguments.position, false, arguments.zero);
    of.settle_places(begins, arguments.state);
    input.begin_at(begins);
    const auto text = arguments.summary == SummaryKind::json ? check_json : check_text;
    Survey survey(of.machine, input.name());
    survey.read(input);
    ProgramFindings findings{survey.problems().texts(), survey.problems().count(), survey.notes(), input.left_out()};
    const std::vector<std::string> dialect = input.dialect_notes();
    findings.notes.insert(findings.notes.begin(), dialect.begin(), dialect.end());
    add_outside(arguments, of, begins, survey, findings);
    if (!findings.problems.empty()) {
        if (!arguments.outputs.report.empty()) {
            write_problems(arguments, of.machine, figures.segment_ticks, input, findings, of.places(begins, true));
        }
        print_whole(text(survey.report(), of.machine, findings), "the report");
        return 1;
    }
    ProgramReport report(of.machine);
    MotionArguments motion_arguments = arguments.motion;
    motion_arguments.enforce = false;
    motion_arguments.quiet = true;
    motion_arguments.progress = true;
    motion_arguments.measures = !arguments.outputs.report.empty();
    motion_arguments.report = &report;
    const PathLimits path_limits(of.machine);
    std::optional<RunReport> page;
    if (!arguments.outputs.report.empty()) {
        motion_arguments.record = &page.emplace(arguments.outputs.report, of.machine, figures.segment_ticks).record();
    }
    Outputs outputs(arguments.outputs, input.curve_name(), false, of.machine);
    LiveMachine none;
    Motion motion(motion_arguments, of.machine, figures, input, path_limits, outputs, none);
    const std::string stopped = motion.run(survey.report().feeds().moves + survey.report().rapids().moves);
    Summary summary = motion.summary();
    summary.places = of.places(begins, true);
    if (page) {
        page->write(report_facts(input, summary, stopped));
    }
    if (!stopped.empty()) {
        findings.problems.push_back(stopped);
        findings.problem_count = 1;
    }
    findings.cycle_time_s = summary.cycle_time_s;
    print_whole(text(report, of.machine, findings), "the report");
    return stopped.empty() ? 0 : 1;
}

} // namespace splinefeed::host
