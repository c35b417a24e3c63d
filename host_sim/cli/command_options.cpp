// SPDX-License-Identifier: MIT
#include "host_sim/cli/command_options.hpp"

#include "host_sim/base/nearest_name.hpp"
#include "host_sim/ports/target_table.hpp"

namespace splinefeed::host {

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
    const std::string group = "Curve";
    const auto option = [&app, &group](const char* name, std::optional<std::string>& value, const char* text) {
        app.add_option(name, value, text)->group(group);
    };
    option("--curve", curve.method,
           (listed(curve_names()) + " (default g2); docs/explanation/curves.md compares them").c_str());
    app.add_flag("--closed", curve.closed, "return to the first waypoint, smoothly")
        ->group(group)
        ->disable_flag_override();
    app.add_flag("--smooth", curve.smooth,
                 "join the segments of a curve whose curvature jumps (catmull-rom and others) with G2: quintics")
        ->group(group)
        ->disable_flag_override();
    option("--parameterization", curve.parameterization,
           "uniform, chordal or centripetal (default: catmull-rom centripetal, else chordal)");
    option("--degree", curve.degree,
           "of bspline, 2 or 3, bspline-interpolation, 1 to 9, beta-chain, 2 to 9 (default 3)");
    option("--knots", curve.knots, "of bspline-interpolation: uniform or averaged (default averaged)");
    option("--tension", curve.tension,
           "of catmull-rom, 0 to 10 (default 0.5); factor of catmull-rom-modified, 0 to 2, constant 0 to 65536 mm "
           "(default 1)");
    option("--factor", curve.factor,
           "of catmull-rom-modified: chord, the tension times each chord, or constant, the tension in mm (default "
           "chord)");
    option("--beta1", curve.beta1, "bias of g2-bezier (default: the ratio of the chords) and beta-chain (default 1)");
    option("--beta2", curve.beta2, "tension of g2-bezier, not below 0, and beta-chain (default 0)");
    option("--lambda", curve.lambda, "of ferguson: ratio of the tangents at each point, 1/16 to 16 (default 1)");
    option(
        "--mu", curve.mu,
        "of ferguson: tension, -65536 to 65536, or auto, the nearest to 0 that keeps the solve stable (default auto)");
    option("--curvature-sign", curve.curvature_sign,
           "of ferguson: 1, -1 (flips the curvature at every point) or auto (-1 at inflections; default 1)");
    option("--corner-angle", curve.corner_angle,
           "a turn sharper than this, in degrees, is a corner: the machine stops there (default 60; bspline 180, "
           "no corners)");
    option("--tolerance", curve.tolerance,
           "MM: of polyline, how far the path may be from the lines, 0 to 100 (default 0: exact, with a stop at each "
           "corner); of elements and of G-code that state none (default: the machine file's)");
    option("--start-tangent", curve.start_tangent,
           "X,Y,Z: direction at the start, in units of the first chord (ferguson, bspline-interpolation: the "
           "derivative)");
    option("--end-tangent", curve.end_tangent, "X,Y,Z: the same at the end");
    app.add_option("--scalar", typed.scalar,
                   "fixed, float or double: number type of the computation (default fixed, as on a microcontroller); "
                   "float not with a jerk limit")
        ->group(group);
}

void add_gcode_options(CLI::App& app, Job& job) {
    GcodeArguments& gcode = job.run.path.gcode;
    const std::string group = "G-code";
    app.add_option("--dialect", gcode.dialect,
                   "linuxcnc, grbl, marlin, fanuc, klipper: whose words they are (default linuxcnc); auto: as the "
                   "first 200 lines say")
        ->group(group);
    app.add_option(
           "--ignore", gcode.ignore,
           "M104,E,START_PRINT,$*,...: words and lines that are left out; unknown: all that the dialect does not have")
        ->group(group);
    app.add_option("--tools", gcode.tools, "tool.tbl: lengths of tools for G43, a line T1 P1 Z12.5 D6 for each")
        ->group(group);
    app.add_flag("--increments", gcode.increments,
                 "fanuc: lengths without a decimal point count 0.001 mm, in inches 0.0001")
        ->group(group)
        ->disable_flag_override();
    app.add_flag("--block-delete", gcode.block_delete, "leave out the lines that begin with /")
        ->group(group)
        ->disable_flag_override();
    app.add_option("--state", job.run.state,
                   "S.json: work offsets, stored positions and where the machine stands, from run to run")
        ->group(group);
    app.add_option("--position", job.run.position,
                   "X,Y,Z: where the machine stands, in its own coordinates (default: with --home 0, else as --state "
                   "says, else where the drives say, else 0)")
        ->group(group);
    app.add_flag("--optional-stop", gcode.optional_stop, "pause at M1")->group(group)->disable_flag_override();
}

void add_machine_options(CLI::App& app, Job& job, Typed& typed, bool executes) {
    app.add_option("-m,--machine", typed.machine, "machine file (.toml) (default: three axes, 100 mm/s, 1000 mm/s^2)");
    if (executes) {
        app.add_option("--target", job.run.target,
                       "sim: the simulated machine in this process (default); " + target_help());
        app.add_option("--start", typed.start,
                       "check, move or here: what to do when the machine stands elsewhere than its program begins: "
                       "refuse (default), move there in a straight line, or begin where it stands; not of sim");
        app.add_flag("--reset", job.run.options.reset, "reset faults of the drives first (modbus)")
            ->disable_flag_override();
        app.add_flag("--home", job.run.options.home,
                     "find the references of the axes before the program begins; not of sim")
            ->disable_flag_override();
        app.add_flag("--probe", job.run.options.probe,
                     "end the run where the probe touches (gpio://); exit status 1 if it never does")
            ->disable_flag_override();
    }
    app.add_option("--window", typed.window,
                   "look-ahead of the feed plan in cells, 10 to 1000000 (default 1024); with a jerk limit a quarter "
                   "is planned at once, at least 16");
    app.add_option("--jerk-scalar", typed.jerk_scalar,
                   "double or float: number type of the plan with a jerk limit (default double; float as on a "
                   "microcontroller)");
    app.add_option("--events", job.run.motion.events,
                   "E.csv: what an operator does during the run, rows t,hold|resume|abort or t,override,0 to 2");
    const std::string group = "Outputs (- is standard output)";
    app.add_option("--trace", job.run.outputs.trace, "T.csv: positions and speed at every sample period")->group(group);
    for (std::size_t i = 0; i < segment_output_kinds().size(); ++i) {
        const SegmentOutputKind& kind = segment_output_kinds()[i];
        app.add_option(kind.option, job.run.outputs.of_segments[i], kind.help)->group(group);
    }
    app.add_option("--curve-out", job.run.outputs.curve, "C.json: the curve as Bezier segments")->group(group);
    app.add_option("--elements", job.run.outputs.elements,
                   "E.json: the programmed path as elements; of G-code and elements")
        ->group(group);
    app.add_option("--report", job.run.outputs.report,
                   "R.html: a page that shows the motion, its limits and the program in a browser")
        ->group(group);
    app.add_option("--summary", typed.summary, "text or json, on standard output (default text)")->group(group);
    app.add_flag_callback(
           "--no-advice", [&job] { job.run.helps = false; },
           "leave out what would help: for it the program is planned again for each limit that binds")
        ->group(group)
        ->disable_flag_override();
    app.add_flag("--quiet", job.run.motion.quiet, "no progress and no warnings on standard error")
        ->group(group)
        ->disable_flag_override();
}

} // namespace splinefeed::host
