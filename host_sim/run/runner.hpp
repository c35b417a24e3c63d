// SPDX-License-Identifier: MIT
// runner: input -> curve -> trajectory -> machine, and the outputs.
#pragma once

#include "host_sim/config/machine_choice.hpp"
#include "host_sim/output/outputs.hpp"
#include "host_sim/ports/run_target.hpp"
#include "host_sim/program/path_input.hpp"
#include "host_sim/report/run_report.hpp"
#include "host_sim/run/motion.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace splinefeed::host {

enum class SummaryKind { none, text, json };

/// What a run has done, for whoever called it in the same process.
struct RunResult {
    Summary summary;
    std::string stopped;            ///< why it ended before the program; empty: it did not
    std::vector<std::string> notes; ///< what else a user should know, sentences
};

struct RunArguments {
    PathArguments path;
    MotionArguments motion;
    std::string machine;                           ///< empty: not named; MachineChoice
    std::vector<std::string> settings{};           ///< of --set
    std::optional<MachineDescription> described{}; ///< in the place of `machine`
    std::string target = "sim";                    ///< only the simulated machine; or "modbus", or an address
    std::string state;                             ///< file of offsets and position; empty: none
    std::string position;                          ///< where the machine stands, "X,Y,Z"; empty: as the state says
    std::string zero;                              ///< of a program in G-code: where its zero lies; empty: likewise
    RunOptions options;
    OutputNames outputs;
    bool helps = true; ///< the summary says what would help, where the program can be planned again
    SummaryKind summary = SummaryKind::text;
    RunResult* result = nullptr; ///< gets what standard output and error would; null: they do
};

/// Plans a path and executes it. Returns the exit status: 0 done, 1 the machine did not finish (reported on standard
/// error). Throws InputError, UsageError and OutputError if the run cannot start (exit status 2); then no output is
/// left.
///
/// A file is checked completely, limits included, before anything moves. A pipe moves the machine while it is read, in
/// constant memory: an error after the first move ends the run with a controlled stop.
[[nodiscard]] int run(const RunArguments& arguments);

/// Of input that is valid, but whose curve is hardly what was meant; what the dialect was taken to be.
/// @param mark  of the former: "warning: "
[[nodiscard]] std::vector<std::string> path_notes(const PathInput& input, std::string_view mark = {});

[[nodiscard]] MachineChoice machine_of(const RunArguments& arguments);

/// What the page of a run or of a check says beside the motion. The summary must outlive it.
/// @param stopped  ReportFacts::stopped
[[nodiscard]] ReportFacts report_facts(const PathInput& input, const Summary& summary, const std::string& stopped);

/// Writes the curve through the points as Bezier segments; nothing moves. Returns 0. Throws like run().
[[nodiscard]] int draw(const RunArguments& arguments);

/// A program in G-code without a machine: everything that is wrong with it, what it does, and how long it takes.
/// Prints the report on standard output: as text, or as JSON if the summary is asked for as that. Returns 0, or 1 if
/// the program has problems. Throws like run().
[[nodiscard]] int check_program(const RunArguments& arguments);

} // namespace splinefeed::host
