// SPDX-License-Identifier: MIT
#include "curve_choice.hpp"

#include "input_error.hpp"
#include "nearest_name.hpp"
#include "number_text.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

/// One row per method: a new method adds its own.
struct Row {
    Method method;
    std::string_view name;
    bool parameterization;
    bool tension;
    bool corners;
    bool tangents;
    Parameterization usual;
};

constexpr std::array table{
    Row{Method::g2, "g2", true, false, true, true, Parameterization::chordal},
    Row{Method::catmull_rom, "catmull-rom", true, true, true, false, Parameterization::centripetal},
    Row{Method::polyline, "polyline", false, false, false, false, Parameterization::chordal},
};
constexpr std::array<std::string_view, table.size()> available{table[0].name, table[1].name, table[2].name};

const Row& find_method(std::string_view name) {
    for (const Row& row : table) {
        if (row.name == name) {
            return row;
        }
    }
    if (name == "bezier") {
        throw UsageError(
            "--curve bezier: a Bezier curve is read from a curve file (.json), without --curve; from waypoints "
            "there are " +
            listed(available));
    }
    throw UsageError(
        fmt::format("--curve {}: there is no such method; available are {}", in_quotes(name), listed(available)));
}

double read(std::string_view option, std::string_view text, double low, double high, std::string_view what) {
    double value = 0.0;
    const NumberText result = read_number(text, value);
    if (result != NumberText::number) {
        throw UsageError(fmt::format("{} {} {}", option, in_quotes(text), why_no_number(result)));
    }
    if (value < low || value > high) {
        throw UsageError(fmt::format("{} {} is out of range; {} must lie between {} and {}", option, in_quotes(text),
                                     what, low, high));
    }
    return value;
}

Parameterization read_parameterization(std::string_view text) {
    constexpr std::array<std::string_view, 3> names{"uniform", "chordal", "centripetal"};
    const auto* const found = std::find(names.begin(), names.end(), text);
    if (found == names.end()) {
        throw UsageError(fmt::format("--parameterization {}: it must be one of {}", in_quotes(text), listed(names)));
    }
    return static_cast<Parameterization>(found - names.begin());
}

Tangent read_tangent(std::string_view option, std::string_view text) {
    Tangent tangent;
    bool zero = true;
    for (std::string_view rest = text;;) {
        const std::size_t comma = rest.find(',');
        if (tangent.components == max_axes) {
            throw UsageError(fmt::format("{} {} has more than {} components", option, in_quotes(text), max_axes));
        }
        const double value = read(option, rest.substr(0, comma), -100.0, 100.0, "each component of an end tangent");
        tangent.value[static_cast<unsigned>(tangent.components++)] = value;
        zero = zero && value == 0.0;
        if (comma == std::string_view::npos) {
            break;
        }
        rest.remove_prefix(comma + 1);
    }
    if (zero) {
        throw UsageError(fmt::format("{} {} has no direction; give a vector like 1,0,0", option, in_quotes(text)));
    }
    return tangent;
}

} // namespace

std::string_view method_name(Method method) noexcept {
    for (const Row& row : table) {
        if (row.method == method) {
            return row.name;
        }
    }
    return "bezier";
}

CurveChoice choose_curve(const CurveArguments& arguments) {
    const Row& row = find_method(arguments.method.value_or("g2"));
    CurveChoice choice;
    choice.method = row.method;
    choice.closed = arguments.closed;
    choice.parameterization = row.usual;
    const auto require = [&row](bool takes, std::string_view option) {
        if (!takes) {
            throw UsageError(fmt::format("--curve {} has no option {}; leave it out", row.name, option));
        }
    };
    if (arguments.parameterization) {
        require(row.parameterization, "--parameterization");
        choice.parameterization = read_parameterization(*arguments.parameterization);
    }
    if (arguments.tension) {
        require(row.tension, "--tension");
        choice.tension = read("--tension", *arguments.tension, 0.0, 10.0, "the tension");
    }
    if (arguments.corner_angle) {
        require(row.corners, "--corner-angle");
        choice.corner_angle_deg =
            read("--corner-angle", *arguments.corner_angle, 0.0, 180.0, "the corner angle in degrees");
    }
    for (const auto& [text, option, tangent] :
         {std::tuple{&arguments.start_tangent, "--start-tangent", &choice.start_tangent},
          std::tuple{&arguments.end_tangent, "--end-tangent", &choice.end_tangent}}) {
        if (!*text) {
            continue;
        }
        require(row.tangents, option);
        if (choice.closed) {
            throw UsageError(fmt::format("{} and --closed exclude each other: a closed curve has no ends", option));
        }
        *tangent = read_tangent(option, **text);
    }
    return choice;
}

std::string_view first_option(const CurveArguments& arguments) noexcept {
    return arguments.method             ? "--curve"
           : arguments.closed           ? "--closed"
           : arguments.parameterization ? "--parameterization"
           : arguments.tension          ? "--tension"
           : arguments.corner_angle     ? "--corner-angle"
           : arguments.start_tangent    ? "--start-tangent"
           : arguments.end_tangent      ? "--end-tangent"
                                        : "";
}

} // namespace splinefeed::host
