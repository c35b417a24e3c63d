// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/macro_variables.hpp"

#include "support/catch.hpp"

#include "splinefeed/s0_program/expression.hpp"
#include "splinefeed/s0_program/interpreter.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

/// A program of a machine in the dialect fanuc.
struct Program {
    explicit Program(const std::vector<std::string>& names = {"x", "y", "z", "a"}) : axes(names) {
        ProgramSettings settings;
        settings.dialect = Dialect::fanuc;
        settings.axes = static_cast<int>(axes.size());
        for (std::size_t k = 0; k < axes.size(); ++k) {
            settings.letters[k] = upper_case(axes[k].front());
        }
        interpreter.emplace(settings, &expression);
        interpreter->start({});
        variables.follow(*interpreter);
    }
    ProgramError push(const std::string& line) {
        const BlockStatus status = interpreter->push(line, 1);
        for (ProgramItem<double> item; status.ok() && interpreter->next(item) == Pull::item;) {
        }
        return status.error;
    }
    /// What is read, or -1 if it is refused.
    double value(std::int32_t number) {
        if (push("#1=#" + std::to_string(number)) != ProgramError::none) {
            return -1.0;
        }
        Decimal out;
        REQUIRE(memory.read(1, out));
        return static_cast<double>(out.raw) / 1e9;
    }

    std::vector<std::string> axes;
    ParameterMemory memory;
    MacroVariables variables{memory, axes};
    Expression expression{variables};
    std::optional<Interpreter<double>> interpreter;
};

} // namespace

TEST_CASE("Modes are those before the block") {
    Program program;
    CHECK(program.value(4001) == -1.0); // no motion yet
    program.push("G1 X1 F500 G91 G18 G94 G21 G99 G55 S1200 T7");
    const std::pair<int, double> modes[] = {{4001, 1},    {4002, 18}, {4003, 91}, {4005, 94}, {4006, 21},
                                            {4007, 40},   {4009, 80}, {4010, 99}, {4014, 55}, {4109, 500},
                                            {4119, 1200}, {4120, 7},  {4012, -1}, {4008, -1}, {4130, -1}};
    for (const auto& [number, mode] : modes) {
        CAPTURE(number);
        CHECK(program.value(number) == mode);
    }
    program.push("G90 G17 G98 G0 X5");
    program.push("G81 R2 Z-1 F100");
    CHECK((program.value(4009) == 81.0 && program.value(4001) == 0.0));
    CHECK((program.value(4002) == 17.0 && program.value(4003) == 90.0 && program.value(4010) == 98.0));
    program.push("G80 G19 G20 G93");
    CHECK((program.value(4002) == 19.0 && program.value(4006) == 20.0 && program.value(4005) == 93.0));
    program.push("G59.1");
    CHECK(program.value(4014) == -1.0);
}

TEST_CASE("Positions are those where the last block ends") {
    Program program;
    program.push("#5222=4");
    program.push("G0 X10 Y-2 A30");
    CHECK((program.value(5001) == 10.0 && program.value(5002) == -2.0 && program.value(5004) == 30.0));
    CHECK((program.value(5021) == 10.0 && program.value(5022) == 2.0 && program.value(5042) == -2.0));
    CHECK((program.value(5005) == -1.0 && program.value(5007) == -1.0)); // no such axis
    program.push("G20 G0 X1");
    CHECK((program.value(5001) == 1.0 && program.value(5041) == 1.0 && program.value(5021) == -1.0));
    program.push("G43.1 Z1");
    CHECK((program.value(5001) == 1.0 && program.value(5043) == -1.0)); // it has the length of the tool in it
    program.push("G49");
    CHECK(program.value(5043) == 0.0);
}

TEST_CASE("An axis that is another one by its number is refused") {
    Program program({"x", "y", "z", "b"});
    CHECK((program.value(5003) == 0.0 && program.value(5004) == -1.0));
    CHECK((program.value(5223) == 0.0 && program.value(5224) == -1.0));
    CHECK(
        (program.push("#5224=1") == ProgramError::parameter_refused && program.push("#5223=1") == ProgramError::none));
    CHECK(program.push("#5230=45") == ProgramError::none); // a rotation, as of G10 L2 R
}

TEST_CASE("#500 to #999 have no value until the program sets it") {
    Program program;
    CHECK(program.push("G0 X#500") == ProgramError::parameter_refused);
    CHECK(program.value(999) == -1.0);
    CHECK(program.push("#500=7") == ProgramError::none);
    CHECK((program.value(500) == 7.0 && program.value(501) == -1.0));
    CHECK(program.push("#999=#0") == ProgramError::none); // known to have none
    CHECK(program.push("G0 X#999 Y1") == ProgramError::none);
    CHECK(program.push("G0 X#199") == ProgramError::none); // vacant
}

TEST_CASE("Variables of the control cannot be set, and others do not exist") {
    Program program;
    for (const char* line : {"#4001=1", "#5001=1", "#5041=1", "#3003=1", "#3000=1", "#1100=1", "#1=#3001", "#1=#2001",
                             "#1=#5201", "#1=#5400", "#1=#5405", "#1=#5428", "#1=#7001", "#1=#100000"}) {
        CAPTURE(line);
        CHECK(program.push(line) == ProgramError::parameter_refused);
    }
}

TEST_CASE("Without macros it is the memory alone") {
    ParameterMemory memory;
    const std::vector<std::string> axes{"x"};
    MacroVariables variables(memory, axes);
    Decimal value;
    CHECK((variables.write(4001, Decimal{5}) && variables.read(4001, value) && value == Decimal{5}));
    CHECK((variables.write("name", Decimal{6}) && variables.read("Name", value) && value == Decimal{6}));
    variables.forget("name");
    variables.forget(4001);
    CHECK_FALSE((variables.read("name", value) || variables.read(4001, value)));
}
