// SPDX-License-Identifier: MIT
#include "host_sim/cli/command_options.hpp"

#include "host_sim/base/nearest_name.hpp"
#include "host_sim/cli/schema_command.hpp"
#include "host_sim/convert/limit_trial.hpp"
#include "host_sim/convert/machine_source.hpp"
#include "host_sim/drive/drive_faults.hpp"
#include "host_sim/ports/target_table.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

/// What is added from now on.
void in_group(CLI::App& app, const char* name = "Options") {
    app.option_defaults()->group(name);
}

void add_input(CLI::App& app, Job& job, Typed& typed) {
    app.add_option("FILE", job.run.path.input,
                   "G-code (.ngc, .nc, .gcode, .gco, .gc, .tap, .cnc, .g), waypoints (.csv), or a curve or elements "
                   "(.json); - reads "
                   "standard input")
        ->required();
    app.add_option("--format", typed.format,
                   input_formats(" or ") + ": format of the input (default: by its name; of standard input csv)");
}

void add_curve_options(CLI::App& app, Job& job, Typed& typed) {
    CurveArguments& curve = job.run.path.curve;
    in_group(app, "Curve");
    app.add_option("--curve", curve.method,
                   listed(curve_names()) + " (default g2); docs/explanation/curves.md compares them");
    app.add_flag("--closed", curve.closed, "return to the first waypoint, smoothly");
    app.add_flag("--smooth", curve.smooth,
                 "join the segments of a curve whose curvature jumps (catmull-rom and others) with G2: quintics");
    app.add_option("--parameterization", curve.parameterization,
                   "uniform, chordal or centripetal (default: catmull-rom centripetal, else chordal)");
    app.add_option("--degree", curve.degree,
                   "of bspline, 2 or 3, bspline-interpolation, 1 to 9, beta-chain, 2 to 9 (default 3)");
    app.add_option("--knots", curve.knots, "uniform or averaged (default averaged), of bspline-interpolation");
    app.add_option(
        "--tension", curve.tension,
        "of catmull-rom, 0 to 10 (default 0.5); factor of catmull-rom-modified, 0 to 2, constant 0 to 65536 mm "
        "(default 1)");
    app.add_option(
        "--factor", curve.factor,
        "of catmull-rom-modified: chord, the tension times each chord, or constant, the tension in mm (default "
        "chord)");
    app.add_option("--beta1", curve.beta1,
                   "bias of g2-bezier (default: the ratio of the chords) and beta-chain (default 1)");
    app.add_option("--beta2", curve.beta2, "tension of g2-bezier, not below 0, and beta-chain (default 0)");
    app.add_option("--lambda", curve.lambda,
                   "of ferguson: ratio of the tangents at each point, 1/16 to 16 (default 1)");
    app.add_option(
        "--mu", curve.mu,
        "of ferguson: tension, -65536 to 65536, or auto, the nearest to 0 that keeps the solve stable (default auto)");
    app.add_option("--curvature-sign", curve.curvature_sign,
                   "of ferguson: 1, -1 (flips the curvature at every point) or auto (-1 at inflections; default 1)");
    app.add_option(
        "--corner-angle", curve.corner_angle,
        "a turn sharper than this, in degrees, is a corner: the machine stops there (default 60; bspline 180, "
        "no corners)");
    app.add_option(
        "--tolerance", curve.tolerance,
        "MM: of polyline, how far the path may be from the lines, 0 to 100 (default 0: exact, with a stop at each "
        "corner); of elements and of G-code that state none (default: the machine file's)");
    app.add_option("--start-tangent", curve.start_tangent,
                   "X,Y,Z: direction at the start, in units of the first chord (ferguson, bspline-interpolation: the "
                   "derivative)");
    app.add_option("--end-tangent", curve.end_tangent, "X,Y,Z: the same at the end");
    app.add_option("--scalar", typed.scalar,
                   "fixed, float or double: number type of the computation (default fixed, as on a microcontroller); "
                   "float not with a jerk limit");
    in_group(app);
}

void add_gcode_options(CLI::App& app, Job& job) {
    GcodeArguments& gcode = job.run.path.gcode;
    in_group(app, "G-code");
    app.add_option(
        "--dialect", gcode.dialect,
        "linuxcnc, grbl, marlin, fanuc, klipper or auto: whose words they are (default linuxcnc); auto: as the "
        "first 200 lines say");
    app.add_option("--ignore", gcode.ignore,
                   "M104,E,START_PRINT,$*,...: words and lines that are left out; unknown: all of the machine's that "
                   "the dialect does not have");
    app.add_option("--tools", gcode.tools, "tool.tbl: lengths of tools for G43, a line T1 P1 Z12.5 D6 for each");
    app.add_option("--subprograms", gcode.subprograms,
                   "FOLDER:FOLDER:...: where subprograms in files of their own are looked for, behind the folder of "
                   "FILE");
    app.add_option("--repeat", gcode.repeat, "N: how often a program runs that M99 ends (default 1)");
    app.add_flag("--increments", gcode.increments,
                 "fanuc: lengths without a decimal point count 0.001 mm, in inches 0.0001");
    app.add_flag("--block-delete", gcode.block_delete, "leave out the lines that begin with /");
    app.add_option("--state", job.run.state,
                   "S.json: work offsets, stored positions and where the machine stands, from run to run");
    app.add_option("--position", job.run.position,
                   "X,Y,Z: where the machine stands, in its own coordinates (default: with --home 0, else as --state "
                   "says, else where the drives say, else 0)");
    app.add_option("--zero", job.run.zero,
                   "X,Y,Z: where the program's zero (G54) lies on the machine, in its own coordinates (default: as "
                   "--state says, else 0)");
    app.add_flag("--optional-stop", gcode.optional_stop, "pause at M1");
    in_group(app);
}

// @param beside  where a machine.toml counts, or empty
void add_machine(CLI::App& app, std::optional<std::string>& machine, std::vector<std::string>& settings,
                 const char* beside = "machine.toml beside FILE, else ") {
    app.add_option("-m,--machine", machine,
                   fmt::format("machine file (.toml); without it {}~/.config/splinefeed/machine.toml, else default: "
                               "three axes, 100 mm/s, 1000 mm/s^2",
                               beside));
    app.add_option("--set", settings,
                   "KEY=VALUE in the place of what the machine file states: path.max_feed_mm_s=200, "
                   "axis.x.max_jerk_mm_s3=30000; may be repeated")
        ->allow_extra_args(false);
}

void add_target(CLI::App& app, std::string& target) {
    app.add_option("--target", target, target_help(false));
}

void add_machine_options(CLI::App& app, Job& job, Typed& typed, bool executes) {
    add_machine(app, typed.machine, job.run.settings);
    if (executes) {
        add_target(app, job.run.target);
        app.add_option("--start", typed.start,
                       "check, move or here: what to do when the machine stands elsewhere than its program begins: "
                       "refuse (default), move there in a straight line, or begin where it stands; not of sim");
        app.add_flag("--reset", job.run.options.orders.reset, "reset faults of the drives first (modbus)");
        app.add_flag("--home", job.run.options.orders.home,
                     "find the references of the axes before the program begins; not of sim");
        app.add_flag("--probe", job.run.options.probe,
                     "end the run where the probe touches (gpio://); exit status 1 if it never does");
    }
    app.add_option("--window", typed.window,
                   "look-ahead of the feed plan in cells, 10 to 1000000 (default 1024); with a jerk limit a quarter "
                   "is planned at once, at least 16");
    app.add_option("--jerk-scalar", typed.jerk_scalar,
                   "double or float: number type of the plan with a jerk limit (default double; float as on a "
                   "microcontroller)");
    app.add_option("--events", job.run.motion.events,
                   "E.csv: what an operator does during the run, rows t,hold|resume|abort or t,override,0 to 2");
    in_group(app, "Outputs (- is standard output)");
    app.add_option("--trace", job.run.outputs.trace, "T.csv: positions and speed at every sample period");
    for (std::size_t i = 0; i < segment_output_kinds().size(); ++i) {
        const SegmentOutputKind& kind = segment_output_kinds()[i];
        app.add_option(kind.option, job.run.outputs.of_segments[i], kind.help);
    }
    app.add_option("--curve-out", job.run.outputs.curve, "C.json: the curve as Bezier segments");
    app.add_option("--elements", job.run.outputs.elements,
                   "E.json: the programmed path as elements; of G-code and elements");
    app.add_option("--report", job.run.outputs.report,
                   "R.html: a page that shows the motion, its limits and the program in a browser");
    app.add_option("--summary", typed.summary, "text or json (default text), on standard output");
    app.add_flag_callback(
        "--no-advice", [&job] { job.run.helps = false; },
        "leave out what would help: for it the program is planned again for each limit that binds");
    app.add_flag("--quiet", job.run.motion.quiet, "no progress and no warnings on standard error");
    in_group(app);
}

void add_surface_options(CLI::App& app, SurfaceArguments& arguments) {
    in_group(app, "Tool path");
    app.add_option("--along", arguments.along,
                   "u or v: the parameter that runs along the lines (default: no path, the surface)");
    app.add_option("--lines", arguments.lines, "number of lines, 2 to 100000");
    app.add_option("--scallop", arguments.scallop, "instead: as many as leave ridges of this height [mm] at most");
    app.add_option("--ball-radius", arguments.ball_radius,
                   "of a ball-nosed cutter [mm] (default 0: the path is on the surface)");
    app.add_option("--tool", arguments.tool, "centre or tip: what of the ball the path is that of (default tip)");
    app.add_option("--pattern", arguments.pattern, "zigzag or one-way (default zigzag), lifted for the way back");
    app.add_option("--lift", arguments.lift,
                   "one-way: height of the way back above the highest control point [mm] (default 5)");
    app.add_option("--step", arguments.step, "largest distance of waypoints [mm] (default 1)");
    in_group(app);
    app.add_option("-o,--output", arguments.output,
                   "WAYPOINTS.csv or CURVE.json (default: standard output, waypoints)");
}

void add_drive_options(CLI::App& app, DriveArguments& arguments) {
    app.add_option(
        "--listen", arguments.listen,
        "tcp://127.0.0.1:1502 (default; ?unit=1), port 0: a free one; or rtu:///dev/pts/3?baud=115200&parity=E&unit=1, "
        "with &pace=off faster than a line of that rate");
    app.add_option("--profile", arguments.profile,
                   "the drive that it plays: a name or FILE.toml (default splinefeed-pvt)");
    app.add_flag("--list-profiles", arguments.list_profiles, "print the profiles and do nothing else");
    app.add_option("--axes", arguments.axes, "1 to 6 (default 3; other profiles than splinefeed-pvt have one)");
    app.add_option("--position", arguments.position, "A,B,C: where the shafts stand at first [counts] (default 0)");
    app.add_option("--ring", arguments.ring, "segments that it holds, 16 to 65535 (default 512)");
    app.add_option("--ramp", arguments.ramp, "of a spindle (profiles vfd-...), up and down [Hz/s] (default 200)");
    app.add_option("--faults", arguments.faults,
                   list_drive_faults() +
                       "; P: probability per exchange, MS: for so long, S: when, N: a number; several with commas");
    app.add_flag("--allow-remote", arguments.allow_remote, "listen to other computers, too");
    in_group(app, "Shafts (one value, or one for each axis)");
    app.add_option("--max-velocity", arguments.max_velocity, "[counts/s]; beyond is a fault (default: none)");
    app.add_option("--max-acceleration", arguments.max_acceleration, "[counts/s^2]; beyond is a fault (default: none)");
    app.add_option("--stop-deceleration", arguments.stop_deceleration, "of a quick stop [counts/s^2] (default 2e6)");
    in_group(app, "Position loop");
    app.add_option("--bandwidth", arguments.bandwidth, "[Hz] (default 60)");
    app.add_option("--damping", arguments.damping, "0 to 0.999 (default 0.7)");
    app.add_option("--feed-forward", arguments.feed_forward, "of the acceleration; 1 follows exactly (default 1)");
    in_group(app, "Outputs");
    app.add_option("--record", arguments.record, "T.csv: where the shafts are, each millisecond [counts]");
    app.add_option("--record-segments", arguments.record_segments, "S.csv: each segment when it was executed");
    in_group(app);
}

void add_link_options(CLI::App& app, LinkArguments& arguments, Typed& typed) {
    app.add_option("--target", arguments.target, target_help(true));
    add_machine(app, typed.machine, arguments.settings, "");
    app.add_option("--seconds", arguments.seconds, "how long to measure, 0.1 to 3600 (default 3)");
}

void add_serve_options(CLI::App& app, ServeArguments& arguments, Typed& typed) {
    add_machine(app, typed.machine, arguments.settings, "");
    add_target(app, arguments.target);
    app.add_option("--tcp", arguments.tcp, "127.0.0.1:PORT: where senders connect; port 0: a free one");
    app.add_option("--pty", arguments.pty, "FILE: a link to a pseudo terminal, a serial port for senders");
    app.add_option("--state", arguments.state,
                   "S.json: where the machine stands, and work offsets, from one session to the next");
}

void add_check(CLI::App& app, Job& job, Typed& typed) {
    CLI::App* const check =
        app.add_subcommand("check", "Say what is wrong with a program in G-code, and how long it takes");
    add_input(*check, job, typed);
    check->get_option("FILE")->description("a program in G-code (.ngc, .nc, .gcode, .gco, .gc, .tap, .cnc, .g)");
    check->get_option("--format")->description("gcode: format of the input, whatever its name is");
    add_machine(*check, typed.machine, job.run.settings);
    check->add_option("--tolerance", job.run.path.curve.tolerance,
                      "MM: of G64 without P, and of a program without G64, 0 to 100 (default: the machine file's)");
    add_gcode_options(*check, job);
    check->add_option("--scalar", typed.scalar,
                      "fixed, float or double: number type of the computation (default double, which is faster); float "
                      "not with a jerk limit");
    check->add_option("--report", job.run.outputs.report,
                      "R.html: a page that shows the motion, its limits and the program in a browser");
    check->add_flag("--json", typed.json, "print one JSON object");
    check->footer("Example: splinefeed check part.ngc -m three_axis.toml\n"
                  "Exit status: 0 nothing is wrong; 1 the program has problems; 2 it cannot be read, or bad usage.");
}

void add_curve(CLI::App& app, Job& job, Typed& typed) {
    CLI::App* const curve = app.add_subcommand("curve", "Print the curve through the points as Bezier segments");
    add_input(*curve, job, typed);
    add_curve_options(*curve, job, typed);
    curve->add_option("-o,--curve-out", job.run.outputs.curve, "C.json (default: standard output)");
    curve->add_flag("--quiet", job.run.motion.quiet, "no warnings on standard error");
    curve->footer(std::string("Example: splinefeed curve part.csv --closed -o part.json\n") + exit_statuses);
}

void add_surface(CLI::App& app, Job& job, Typed& typed) {
    CLI::App* const surface = app.add_subcommand("surface", "Print a surface, or a tool path on it");
    surface->add_option("FILE", job.run.path.input, "a grid or sections (.json); - reads standard input")->required();
    surface->add_option("--format", typed.format, "json: format of the input, whatever its name is");
    add_surface_options(*surface, job.surface);
    surface->add_flag("--quiet", job.run.motion.quiet, "no warnings on standard error");
    surface->add_option("--scalar", typed.scalar,
                        "fixed, float or double: number type of parameters, knots and control points (default double)");
    surface->footer(std::string("Example: splinefeed surface dome.json --along u --scallop 0.01 --ball-radius 6 -o "
                                "path.csv\n") +
                    exit_statuses);
}

void add_machine_command(CLI::App& app, Job& job) {
    CLI::App* const machine =
        app.add_subcommand("machine", "Say what is wrong with a machine file, or make one of another controller's");
    machine
        ->add_option("MACHINE", job.run.path.input,
                     "a machine file (.toml), or with -o what another controller has: its answer to $$ or M503, "
                     "its INI file, its printer.cfg; - reads standard input")
        ->required();
    machine->add_flag("--check", job.machine.checks, "say everything that is wrong, not only the first (the default)");
    machine->add_option("--from", job.machine.from,
                        machine_source_names() + ": whose file becomes a machine file (default: as its text says)");
    machine->add_option("--to", job.machine.to,
                        "grbl: write the machine file's numbers as lines like $110=8000, for a controller that takes "
                        "them; --from grbl reads them back");
    machine->add_option("-o,--output", job.machine.output,
                        "MACHINE.toml: the machine file that is made; of --to the lines, of --try the program "
                        "(default: standard output)");
    machine->add_option("--answers", job.machine.answers,
                        "A.toml: what that file does not say; without it a terminal is asked");
    machine->add_option("--try", job.machine.tried,
                        "AXIS: make a program in G-code that tries accelerations of that axis of the machine file");
    machine->add_option("--for", job.machine.tried_by,
                        trial_controllers() + ": whose program --try makes (default grbl)");
    machine->footer("Example: splinefeed machine --check three_axis.toml\n"
                    "         splinefeed machine printer.cfg -o printer.toml\n"
                    "         splinefeed machine printer.toml --try x --for klipper -o try_x.gcode\n"
                    "         splinefeed machine router.toml --to grbl -o settings.txt\n"
                    "Exit status: 0 nothing is wrong; 1 something is; 2 it cannot be read, or bad usage.");
}

void add_schema(CLI::App& app, Job& job) {
    CLI::App* const schema = app.add_subcommand("schema", "Print the JSON schema of a file, for editors and checkers");
    schema->add_option("KIND", job.run.path.input, listed(schema_names()) + ": the file that it describes")->required();
    schema->footer(std::string("Example: splinefeed schema machine > machine.schema.json\n") + exit_statuses);
}

} // namespace

const char* const exit_statuses = "Exit status: 0 done; 1 the machine did not finish (the message says where it "
                                  "stands), a tolerance was not kept, or a "
                                  "drive cannot be used; 2 bad input or usage (the message is one line).";

void describe_commands(CLI::App& app, Job& job, Typed& typed) {
    CLI::App* const run = app.add_subcommand("run", "Plan a path and execute it");
    add_input(*run, job, typed);
    add_machine_options(*run, job, typed, true);
    add_curve_options(*run, job, typed);
    add_gcode_options(*run, job);
    run->footer(std::string("Example: splinefeed run part.csv -m three_axis.toml --trace trace.csv\n") + exit_statuses);
    CLI::App* const plan = app.add_subcommand("plan", "Plan a path without executing it");
    add_input(*plan, job, typed);
    add_machine_options(*plan, job, typed, false);
    add_curve_options(*plan, job, typed);
    add_gcode_options(*plan, job);
    plan->footer(std::string("Example: splinefeed plan part.csv --curve catmull-rom --summary json\n") + exit_statuses);
    add_check(app, job, typed);
    add_curve(app, job, typed);
    add_surface(app, job, typed);
    add_machine_command(app, job);
    add_schema(app, job);
    CLI::App* const drive = app.add_subcommand("drive", "Simulate a Modbus drive until it is interrupted");
    add_drive_options(*drive, job.drive);
    drive->footer("Example: splinefeed drive --listen tcp://127.0.0.1:1502 --axes 3 --record shafts.csv\n"
                  "It prints one line when it listens. After SIGINT (Ctrl-C) or SIGTERM it completes its records and "
                  "exits with 0.");
    CLI::App* const link = app.add_subcommand("link", "Test the link to drives: who answers, how fast, how reliably");
    add_link_options(*link, job.link, typed);
    link->footer(std::string("Example: splinefeed link --target modbus-tcp://192.168.0.10:502?unit=1\n") +
                 exit_statuses);
    CLI::App* const serve = app.add_subcommand("serve", "Operate a machine from a sender of G-code (grbl)");
    add_serve_options(*serve, job.serve, typed);
    serve->footer(
        "Example: splinefeed serve -m three_axis.toml --tcp 127.0.0.1:2300 --pty /tmp/machine\n"
        "It prints one line for each place. With a terminal as its input it takes lines and words there: type "
        "help. Ctrl-C brakes and ends it, a second one stops at once. Exit status: 1 if something may still move, turn "
        "or be on; 2 bad input or usage, or a state file that cannot be written.");
    for (CLI::App* const command : app.get_subcommands([](CLI::App* /*command*/) { return true; })) {
        for (CLI::Option* const option : command->get_options()) {
            option->type_name("");           // the descriptions say what a value may be
            option->disable_flag_override(); // --quiet=no
        }
        command->allow_extras();
        command->set_help_flag("-h,--help", "print this help");
    }
}

} // namespace splinefeed::host
