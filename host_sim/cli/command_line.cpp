// SPDX-License-Identifier: MIT
#include "host_sim/cli/command_line.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/base/option_number.hpp"
#include "host_sim/cli/command_options.hpp"
#include "host_sim/cli/help_pages.hpp"
#include "host_sim/cli/schema_command.hpp"
#include "host_sim/ports/target_table.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <span>

namespace splinefeed::host {

namespace {

#ifndef SPLINEFEED_VERSION
#define SPLINEFEED_VERSION "unknown"
#endif

/// The options of an app by their long names, as they are typed.
std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) {
            names.push_back("--" + name);
        }
        for (const std::string& name : option->get_snames()) {
            names.push_back("-" + name);
        }
    }
    return names;
}

bool takes_no_input(const CLI::App& app) {
    return app.get_name() == "drive" || app.get_name() == "link" || app.get_name() == "serve";
}

// CLI11 would take -machine for -m achine.
void refuse_short_names(const CLI::App& app, std::span<const char* const> words) {
    const std::vector<std::string> names = option_names(app);
    for (const std::string_view word : words) {
        const std::string name = fmt::format("-{}", word.substr(0, word.find('=')));
        if (word.size() > 2 && word[0] == '-' && std::ranges::find(names, name) != names.end()) {
            throw UsageError("'{}' has no option {}; did you mean '{}'?", app.get_name(), in_quotes(word), name);
        }
    }
}

// What CLI11 did not know: an option, or one word too many.
void refuse_extras(const CLI::App& app, const Job& job) {
    for (const std::string& word : app.remaining()) {
        if (word.size() > 1 && word.front() == '-') {
            const std::vector<std::string> names = option_names(app);
            const std::vector<std::string_view> known(names.begin(), names.end());
            const std::string_view near = meant_name(word.substr(0, word.find('=')), known);
            throw UsageError("'{}' has no option {}; {}", app.get_name(), in_quotes(word),
                             near.empty() ? fmt::format("see splinefeed {} --help", app.get_name())
                                          : fmt::format("did you mean '{}'?", near));
        }
        throw UsageError(takes_no_input(app) ? fmt::format("'{}' takes no input; {} is one word too many",
                                                           app.get_name(), in_quotes(word))
                                             : fmt::format("there is one input, {}; {} is one word too many",
                                                           in_quotes(job.run.path.input), in_quotes(word)));
    }
}

// CLI11's errors name the option first: "--trace: 1 required TEXT missing".
std::string explained(const CLI::ParseError& error) {
    const std::string_view text = error.what();
    const std::string_view option = text.substr(0, text.find(':'));
    if (text.find("missing") != std::string_view::npos) {
        return fmt::format("{} needs a value; see splinefeed --help", option);
    }
    if (text.find("At Most 1") != std::string_view::npos) {
        return fmt::format("{} is given more than once; give it once", option);
    }
    if (text.find("flag override") != std::string_view::npos) {
        return fmt::format("--{} takes no value; leave it out", text.substr(0, text.find(' ')));
    }
    if (text.find("MACHINE is required") != std::string_view::npos) {
        return "there is no machine file; name a .toml file, or - for standard input";
    }
    if (text.find("KIND is required") != std::string_view::npos) {
        return fmt::format("there is no kind of file; it must be one of {}", listed(schema_names()));
    }
    if (text.find("FILE is required") != std::string_view::npos) {
        return fmt::format("there is no input; name a {} file, or - for standard input", input_formats(" or ", "."));
    }
    return fmt::format("{}; see splinefeed --help", text);
}

void take_format(Job& job, const std::string& format) {
    const std::size_t dot = job.run.path.input.rfind('.');
    const std::string suffix = job.run.path.input == "-"  ? "csv"
                               : dot == std::string::npos ? ""
                                                          : job.run.path.input.substr(dot + 1);
    if (const InputFormat* const known = format.empty() ? format_of_suffix(suffix) : input_format(format)) {
        job.run.path.format = known;
    } else if (!format.empty()) {
        const InputFormat* const meant = format_of_suffix(format); // "ngc" for gcode
        throw UsageError("--format {}: it must be one of {}{}", in_quotes(format), input_formats(", "),
                         meant != nullptr ? fmt::format("; did you mean '{}'?", meant->name) : "");
    } else {
        constexpr std::array<std::string_view, 8> of_shapes{"dxf", "svg", "stl", "step", "stp", "3mf", "obj", "amf"};
        throw UsageError(
            "{}: {}; name a {} file, or add --format {}", in_quotes(job.run.path.input),
            std::ranges::find(of_shapes, CLI::detail::to_lower(suffix)) != of_shapes.end()
                ? "a drawing or a model has no path for a tool, a CAM program or a slicer makes G-code of it"
                : "the name does not say what it is",
            input_formats(" or ", "."), input_formats("|"));
    }
}

void take_start(Job& job, const std::optional<std::string>& start) {
    if (!start) {
        return;
    }
    job.run.options.start = static_cast<StartWay>(require_word("--start", *start, {"check", "move", "here"}));
    if (!target_kind(job.run.target).is_real) {
        throw UsageError("--start is for machines that stand somewhere, and the simulated one stands where its program "
                         "begins; name your machine with --target");
    }
    if (job.run.options.orders.home && job.run.options.start == StartWay::here) {
        throw UsageError("--start here and --home contradict each other: behind --home the machine goes to where its "
                         "program begins; leave one of them out");
    }
}

// One output at most goes to standard output, and no two to one file.
void take_outputs(Job& job, const CLI::App& app, const std::string& summary) {
    std::vector<std::pair<const char*, const std::string*>> files{{"--trace", &job.run.outputs.trace}};
    for (std::size_t i = 0; i < segment_output_kinds().size(); ++i) {
        files.emplace_back(segment_output_kinds()[i].option, &job.run.outputs.of_segments[i]);
    }
    files.emplace_back("--curve-out", &job.run.outputs.curve);
    files.emplace_back("--elements", &job.run.outputs.elements);
    files.emplace_back("--report", &job.run.outputs.report);
    const char* on_stdout = nullptr;
    std::error_code ignored;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const auto& [option, path] = files[i];
        const CLI::Option* const given = app.get_option_no_throw(option);
        if (given != nullptr && given->count() > 0 && path->empty()) {
            throw UsageError("{} needs the name of a file, or - for standard output", option);
        }
        for (std::size_t j = 0; j < i; ++j) {
            if (!path->empty() && *path == *files[j].second && !std::filesystem::is_character_file(*path, ignored)) {
                throw UsageError("{} and {} both go to {}; give each its own", files[j].first, option,
                                 *path == "-" ? "standard output" : in_quotes(*path));
            }
        }
        on_stdout = *path == "-" ? option : on_stdout;
    }
    if (app.get_name() == "check" && on_stdout != nullptr) {
        throw UsageError("--report -: check prints on standard output itself; write the page to a file");
    }
    if (!summary.empty()) {
        require_word("--summary", summary, {"text", "json"});
    }
    if (!summary.empty() && on_stdout != nullptr) {
        throw UsageError("{} - and --summary both go to standard output; write one to a file", on_stdout);
    }
    job.run.outputs.prints_summary = on_stdout == nullptr;
    job.run.summary = on_stdout != nullptr ? SummaryKind::none
                      : summary == "json"  ? SummaryKind::json
                                           : SummaryKind::text;
}

/// As Command has them.
constexpr std::array<std::string_view, 10> commands{"run",   "plan", "check",   "curve",  "surface",
                                                    "drive", "link", "machine", "schema", "serve"};

// What stands in the place of a command, or before it. @param command  the one that is meant
[[noreturn]] void refuse_without_command(const std::vector<std::string>& words, std::string_view command) {
    if (words.empty()) {
        throw UsageError("there is no command; it must be one of " + listed(commands) + "; see splinefeed --help");
    }
    const std::string& word = words.front();
    if (word.size() > 1 && word.front() == '-') {
        throw UsageError("{} stands before the command; write it behind: splinefeed {} {} ...", in_quotes(word),
                         command, word);
    }
    std::error_code ignored;
    const std::size_t dot = word.rfind('.');
    if (word == "-" || (dot != std::string::npos && format_of_suffix(word.substr(dot + 1)) != nullptr) ||
        std::filesystem::exists(word, ignored)) {
        throw UsageError("there is no command before {}; write splinefeed run {}", in_quotes(word), word);
    }
    throw UsageError("there is no command {}{}", in_quotes(word), suggestion(word, commands));
}

// What run, plan, check and curve have in common.
void take_path(Job& job, const CLI::App& command, const Typed& typed) {
    job.run.motion.enforce = job.command == Command::run;
    const bool is_real = target_kind(job.run.target).is_real;
    if (!is_real && job.run.options.orders.home) {
        throw UsageError("--home is for machines with switches or drives, and the simulated one has none: of G-code "
                         "--position says where it stands; name your machine with --target");
    }
    if (job.run.options.orders.reset && job.run.target.rfind("modbus", 0) != 0) {
        throw UsageError(
            "--reset is for drives on Modbus; reset others by their own means, or name yours with --target");
    }
    if (!is_real && job.run.options.probe) {
        throw UsageError("--probe is for machines with switches, and the simulated one has none; name yours with "
                         "--target");
    }
    take_start(job, typed.start);
    take_format(job, typed.format);
    job.run.path.scalar =
        read_scalar("--scalar", typed.scalar.value_or(job.command == Command::check ? "double" : "fixed"),
                    {"fixed", "float", "double"});
    job.run.motion.planner.jerk_scalar = read_scalar("--jerk-scalar", typed.jerk_scalar, {"double", "float"});
    job.run.motion.planner.window_cells = read_window(typed.window);
    take_outputs(job, command, typed.json ? "json" : typed.summary);
    if (job.command == Command::curve && job.run.outputs.curve.empty()) {
        job.run.outputs.curve = "-";
    }
    if (job.run.path.format->kind == InputKind::waypoints) {
        static_cast<void>(choose_curve(job.run.path.curve));
    }
}

/// What is typed without a command, and what applies to all of them.
struct General {
    std::string page;
    bool completion = false;
};

void describe_general(CLI::App& app, General& general) {
    app.set_help_flag("-h,--help", "print this help; options of a command: splinefeed run --help");
    app.set_version_flag("--version", "splinefeed " SPLINEFEED_VERSION);
    app.add_option("--man", general.page, "COMMAND or splinefeed: print its man page");
    app.add_flag("--completion", general.completion, "print the completion of bash: source <(splinefeed --completion)")
        ->disable_flag_override();
    app.footer(std::string("Example: splinefeed run part.csv -m three_axis.toml --trace trace.csv\n") + exit_statuses +
               " check: 1 the program has problems.");
    app.require_subcommand(0, 1);
    app.allow_extras();
}

/// Options of a command that has an input.
std::variant<Job, Answer> take_input(Job& job, const CLI::App& command, Typed& typed) {
    if (command.get_name() == "schema") {
        return Answer{json_schema(job.run.path.input)};
    }
    const bool checks_machine = command.get_name() == "machine";
    if (job.run.path.input.empty()) {
        throw UsageError("the input has no name; give a {} file, or - for standard input",
                         checks_machine ? ".toml" : input_formats(" or ", "."));
    }
    if (checks_machine) {
        return job;
    }
    if (command.get_name() == "surface") {
        static_cast<void>(choose_raster(job.surface));
        if (!typed.format.empty() && typed.format != "json") {
            throw UsageError("--format {}: a surface is described in json", in_quotes(typed.format));
        }
        job.run.path.scalar = read_scalar("--scalar", typed.scalar.value_or("double"), {"fixed", "float", "double"});
        return job;
    }
    take_path(job, command, typed);
    return job;
}

} // namespace

std::variant<Job, Answer> parse_command_line(int argc, const char* const* argv) {
    Job job;
    Typed typed;
    General general;
    CLI::App app("splinefeed turns waypoints and G-code into smooth motion.", "splinefeed");
    describe_general(app, general);
    describe_commands(app, job, typed);
    std::vector<const char*> arguments(argv, argv + argc);
    if (argc > 1 && std::string_view(argv[1]) == "help") { // "help run", as other tools have it
        if (argc > 2 && argv[2][0] != '-' && std::ranges::find(commands, argv[2]) == commands.end()) {
            refuse_without_command({argv[2]}, "run");
        }
        arguments.erase(arguments.begin() + 1);
        arguments.push_back("--help");
    }
    try {
        app.parse(static_cast<int>(arguments.size()), arguments.data());
    } catch (const CLI::CallForHelp&) {
        const auto chosen = app.get_subcommands();
        return Answer{chosen.empty() ? app.help() : chosen.front()->help("splinefeed")};
    } catch (const CLI::CallForVersion& version) {
        return Answer{std::string(version.what()) + "\n"};
    } catch (const CLI::ParseError& error) {
        throw UsageError(explained(error));
    }
    if (!general.page.empty() || general.completion) {
        return Answer{general.completion ? bash_completion(app) : man_page(app, general.page)};
    }
    const auto chosen = app.get_subcommands();
    if (const std::vector<std::string> words = app.remaining(); chosen.empty() || !words.empty()) {
        refuse_without_command(words, chosen.empty() ? "run" : chosen.front()->get_name());
    }
    const CLI::App& command = *chosen.front();
    refuse_short_names(command, {argv, static_cast<std::size_t>(argc)});
    refuse_extras(command, job);
    job.run.machine = typed.machine.value_or("");
    if (typed.machine && job.run.machine.empty()) {
        throw UsageError("--machine needs the name of a .toml file; without the option there is a default machine");
    }
    job.command = static_cast<Command>(std::ranges::find(commands, command.get_name()) - commands.begin());
    if (takes_no_input(command)) {
        job.link.machine = job.serve.machine = job.run.machine;
        return job;
    }
    return take_input(job, command, typed);
}

} // namespace splinefeed::host
