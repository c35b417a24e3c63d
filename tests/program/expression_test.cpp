// SPDX-License-Identifier: MIT
#include "support/gcode.hpp"

#include "support/rounds.hpp"
#include <limits>

#include <cmath>
#include <random>

using namespace splinefeed_test;

namespace {

/// What the text is worth.
double value_of(GcodeRun<double>& run, const std::string& text, ProgramError expected = ProgramError::none,
                std::size_t column = 0) {
    Expression expression(run.table());
    TextCursor cursor(text);
    Decimal out;
    const ProgramStatus status = expression.value(cursor, run.interpreter(), out);
    CAPTURE(text, describe(status.error()));
    CHECK(status.error() == expected);
    CHECK(cursor.column() == (column > 0 ? column : cursor.column()));
    CHECK((!status.ok() || cursor.at_end()));
    return number(out);
}

/// A random expression, its value by double, and how far rounding to 1e-9 may move it.
struct Tree {
    std::string text;
    double value = 0.0;
    double error = 0.0;
};

Tree random_tree(std::mt19937_64& random, int depth) {
    const auto pick = [&](unsigned n) {
        return static_cast<unsigned>(random() % n);
    };
    if (depth == 0 || pick(5) == 0) {
        const auto thousandths = static_cast<int>(pick(20000)) - 10000;
        char text[32];
        std::snprintf(text, sizeof text, "%.3f", thousandths / 1000.0);
        return {text, thousandths / 1000.0};
    }
    const Tree a = random_tree(random, depth - 1);
    const Tree b = random_tree(random, depth - 1);
    switch (pick(10)) {
    case 0: return {"[" + a.text + "+" + b.text + "]", a.value + b.value, a.error + b.error};
    case 1: return {"[" + a.text + " - " + b.text + "]", a.value - b.value, a.error + b.error};
    case 2:
        return {"[" + a.text + "*" + b.text + "]", a.value * b.value,
                1e-9 + std::fabs(a.value) * b.error + std::fabs(b.value) * a.error};
    case 3:
        if (std::fabs(a.value - b.value) <= a.error + b.error) {
            return b;
        }
        return {"[" + a.text + " gt " + b.text + "]", a.value > b.value ? 1.0 : 0.0};
    case 4: return {"sin[" + a.text + "]", std::sin(a.value * M_PI / 180.0), 1e-9 + 0.018 * a.error};
    case 5: return {"Cos[" + a.text + "]", std::cos(a.value * M_PI / 180.0), 1e-9 + 0.018 * a.error};
    case 6: return {"sqrt[abs[" + a.text + "] + 0.01]", std::sqrt(std::fabs(a.value) + 0.01), 1e-9 + 5.0 * a.error};
    case 7: return {"atan[" + a.text + "]/[1.5]", std::atan2(a.value, 1.5) * 180.0 / M_PI, 2e-9 + 39.0 * a.error};
    case 8: return {"ln[abs[" + a.text + "]+1]", std::log(std::fabs(a.value) + 1.0), 1e-9 + a.error};
    default: return {"-[" + a.text + "]", -a.value, a.error};
    }
}

} // namespace

TEST_CASE("values of expressions", "[program][expression]") {
    GcodeRun<double> run;
    run.run("#1=5 #2=7\n#5=2\n#<_side>=1.5\n#< Long Name > = 3");
    const std::pair<const char*, double> table[] = {
        {"[1+2*3]", 7.0},
        {"[2**3**2]", 64.0}, // to the left, as in LinuxCNC
        {"[2*3**2]", 18.0},
        {"[10-4-3]", 3.0},
        {"[-7 mod 4]", 1.0},
        {"[7 MOD -4]", 3.0},
        {"[1 + 1 eq 2]", 1.0},
        {"[0.3 EQ [0.1 + 0.2]]", 1.0},
        {"[1 ne 1.0000005]", 0.0},
        {"[2 ge 2]", 1.0},
        {"[2 lt 2]", 0.0},
        {"[3 le 2]", 0.0},
        {"[1 and 0]", 0.0},
        {"[1 or 0]", 1.0},
        {"[1 xor 1]", 0.0},
        {"[1 GT 0 AND 2 GT 1]", 1.0},
        {"#1", 5.0},
        {"##5", 7.0},
        {"#[1+1]", 7.0},
        {"#99", 0.0},
        {"-#1", -5.0},
        {"#<_Side>", 1.5},
        {"#<longname>", 3.0},
        {"sin[30]", 0.5},
        {"acos[0]", 90.0},
        {"asin[-0.5]", -30.0},
        {"tan[45]", 1.0},
        {"atan[-1]/[-1]", -135.0},
        {"round[2.5]", 3.0},
        {"round[-2.5]", -3.0},
        {"fix[-4.5]", -5.0},
        {"fup[-4.5]", -4.0},
        {"exp[0]", 1.0},
        {"exists[#<_side>]", 1.0},
        {"exists[#<other>]", 0.0},
        {"sqrt[2]", 1.414213562},
        {"#<_metric>", 1.0},
        {"[[1 GT 2]+[3 EQ 3]*48]", 48.0},
    };
    for (const auto& [text, expected] : table) {
        CHECK(std::fabs(value_of(run, text) - expected) < 1.5e-9);
    }
}

TEST_CASE("random expressions agree with double", "[program][expression]") {
    const unsigned seed = random_seed();
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    GcodeRun<double> run;
    for (int i = 0; i < rounds(3000); ++i) {
        const Tree tree = random_tree(random, 3);
        CAPTURE(tree.text);
        REQUIRE(std::fabs(value_of(run, tree.text) - tree.value) < 1e-9 + tree.error);
    }
}

TEST_CASE("results at the end of the range, and beyond", "[program][expression]") {
    GcodeRun<double> run;
    run.run("#1=[92000000*100] #2=[0-92000000*100]");
    for (const char* const function : {"fix", "fup", "round"}) {
        CHECK(value_of(run, std::string(function) + "[#1]") == 9.2e9);
        CHECK(value_of(run, std::string(function) + "[#2]") == -9.2e9);
        CHECK(value_of(run, std::string(function) + "[#1 - 0.5]") >= 9.2e9 - 1.0);
        CHECK(value_of(run, std::string(function) + "[#2 + 0.5]") <= -9.2e9 + 1.0);
    }
    CHECK(value_of(run, "abs[#2]") == 9.2e9);
    CHECK(value_of(run, "-#2") == 9.2e9);
    CHECK(value_of(run, "[#2 mod -1]") == 0.0);
    for (const char* const text : {"[#1 + 0.000000001]", "[#2 - 0.000000001]", "[#2 * 1.1]", "[#1 / 0.5]", "exp[22.95]",
                                   "[96000 ** 2]", "[#2 - 20000000]", "[#2 - #1]"}) {
        value_of(run, text, ProgramError::result_out_of_range);
    }
    run.table().write(9, {std::numeric_limits<std::int64_t>::min()}); // a memory may hold anything
    for (const char* const text : {"abs[#9]", "fix[#9]", "-#9", "[#9 mod -1]"}) {
        value_of(run, text, ProgramError::number_out_of_range);
    }
}

TEST_CASE("wrong expressions are refused where they are wrong", "[program][expression]") {
    GcodeRun<double> run;
    value_of(run, "[1+2", ProgramError::bracket_missing, 5);
    value_of(run, "[1 x 2]", ProgramError::operator_unknown, 4);
    value_of(run, "[1/0]", ProgramError::division_by_zero, 3);
    value_of(run, "[1 mod 0]", ProgramError::division_by_zero);
    value_of(run, "sqrt[-1]", ProgramError::root_of_negative, 1);
    value_of(run, "ln[0]", ProgramError::logarithm_argument);
    value_of(run, "asin[1.1]", ProgramError::arc_function_argument);
    value_of(run, "atan[1]", ProgramError::atan_needs_two);
    value_of(run, "foo[1]", ProgramError::function_unknown, 1);
    value_of(run, "sin 3", ProgramError::bracket_missing, 5);
    value_of(run, "#<none>", ProgramError::parameter_unset, 1);
    value_of(run, "[1 + #<_hal[plasmac.cut-feed-rate]>]", ProgramError::parameter_of_linuxcnc, 6);
    value_of(run, "#<_ini[traj]linear_units>", ProgramError::parameter_of_linuxcnc, 1);
    value_of(run, "#<none", ProgramError::parameter_name_invalid);
    value_of(run, "#0", ProgramError::parameter_out_of_range, 2);
    value_of(run, "#6000", ProgramError::parameter_out_of_range);
    value_of(run, "#1.5", ProgramError::parameter_out_of_range);
    value_of(run, "[100000*100000]", ProgramError::result_out_of_range, 8);
    value_of(run, "[-2 ** 0.5]", ProgramError::power_invalid);
    value_of(run, std::string(40, '['), ProgramError::expression_too_deep);
    value_of(run, std::string(200, '#').append(1, '1'), ProgramError::expression_too_deep);
    value_of(run, "", ProgramError::number_invalid);
}

TEST_CASE("as much as brackets and operators hold waits for one value", "[program][expression]") {
    GcodeRun<double> run;
    std::string begin;
    for (int i = 0; i < Expression::deepest; ++i) {
        begin += "[0 or 5 eq 1 + 2 * 2 ** "; // of 0 and 1 that is themselves
    }
    const std::string end(Expression::deepest, ']');
    CHECK(value_of(run, begin + "0" + end) == 0.0);
    CHECK(value_of(run, begin + "1" + end) == 1.0);
    for (const char* const text : {"-#1", "#1", "sin[0]", "exists[#1]", "[1]"}) {
        value_of(run, begin + text + end, ProgramError::expression_too_deep);
    }
}

TEST_CASE("parameters change at the end of their block", "[program][expression]") {
    GcodeRun<double> run;
    CHECK(run.last("G0 #3=15 X#3") == "rapid 0 0 0");
    CHECK(run.last("X#3") == "rapid 15 0 0");
    CHECK(run.push("#5400=1").error == ProgramError::parameter_read_only);
    CHECK(run.push("#<_x>=1").error == ProgramError::parameter_read_only);
    CHECK(run.push("#1 3").error == ProgramError::assignment_invalid);
    CHECK(run.push("#1=2 G1 X5").error == ProgramError::feed_missing);
    Decimal one;
    CHECK(!run.table().read(1, one)); // nothing of a wrong block happens
    std::string many;
    for (int i = 0; i < 17; ++i) {
        many += "#1=1";
    }
    CHECK(run.push(many).error == ProgramError::too_many_assignments);
}

TEST_CASE("parameters of the control", "[program][expression]") {
    GcodeRun<double> run;
    run.run("G10 L2 P2 X10 Y20 R30\nG55 G0 X1 Y2 Z3\nG92 X5\nT3 M6 G43 H3\nG28.1");
    CHECK(value_of(run, "#5220") == 2.0);
    CHECK(value_of(run, "#5241") == 10.0);
    CHECK(value_of(run, "#5242") == 20.0);
    CHECK(value_of(run, "#5250") == 30.0);
    CHECK(value_of(run, "#5210") == 1.0);
    CHECK(value_of(run, "#5211") == -4.0);
    CHECK(value_of(run, "#5400") == 3.0);
    CHECK(value_of(run, "#5403") == 30.0);
    CHECK(value_of(run, "#5422") == -27.0);
    CHECK(value_of(run, "#<_z>") == -27.0);
    CHECK(value_of(run, "#5163") == 3.0);
    CHECK(value_of(run, "#<_coord_system>") == 550.0);
    run.run("F600 G20");
    CHECK(value_of(run, "#<_feed>") == 600.0); // as it was stated, like LinuxCNC
    run.run("F10 G21");
    CHECK(value_of(run, "#<_feed>") == 10.0);
    CHECK(run.interpreter().modal().feed == Decimal::from_integer(254));
    run.run("G20\nG93 F2");
    CHECK(value_of(run, "#<_feed>") == 2.0); // no length
    run.run("G94 G21 F100");
    CHECK(value_of(run, "#<_feed>") == 100.0);
    run.run("#7=#<_line>");
    CHECK(value_of(run, "#7") == 11.0); // its own
    run.run("#5221=12\nG54 G53 G0 X0\nG20");
    CHECK(std::fabs(value_of(run, "#5422") + 27.0 / 25.4) < 1e-9);
    CHECK(run.interpreter().offsets().systems[0].origin[0] == Decimal::from_integer(12));
}
