// SPDX-License-Identifier: MIT
// What the interpreter costs a block: lines of CAM and slicers, arcs, expressions. items_per_second counts blocks.
#include "splinefeed/s0_program/expression.hpp"
#include "splinefeed/s0_program/interpreter.hpp"

#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace splinefeed;

class NoTable final : public ParameterTable {
public:
    [[nodiscard]] bool read(std::int32_t, Decimal& out) const noexcept override {
        out = Decimal::from_integer(3);
        return true;
    }
    bool write(std::int32_t, Decimal) noexcept override { return true; }
    [[nodiscard]] bool read(std::string_view, Decimal&) const noexcept override { return false; }
    bool write(std::string_view, Decimal) noexcept override { return true; }
    void forget(std::int32_t) noexcept override {}
    void forget(std::string_view) noexcept override {}
};

enum Kind { lines, slicer, arcs, expressions };

std::vector<std::string> program_of(int kind) {
    std::vector<std::string> program;
    for (int i = 0; i < 1000; ++i) {
        char text[100];
        const double x = 50.0 * std::cos(i * 0.0062831853);
        const double y = 50.0 * std::sin(i * 0.0062831853);
        switch (kind) {
        case lines: std::snprintf(text, sizeof text, "X%.3f Y%.3f", x, y); break;
        case slicer: std::snprintf(text, sizeof text, "G1 X%.3f Y%.3f E%.5f", x, y, i * 0.01234); break;
        case arcs:
            std::snprintf(text, sizeof text, "G%d X%d Y0 I%d J0", 2 + i % 2, i % 2 == 0 ? 10 : 0, i % 2 == 0 ? 5 : -5);
            break;
        default: std::snprintf(text, sizeof text, "X[%.3f+#1*2] Y[sin[%d]*10]", x, i); break;
        }
        program.emplace_back(text);
    }
    return program;
}

template <Scalar S>
void block(benchmark::State& state) {
    const int kind = static_cast<int>(state.range(0));
    const std::vector<std::string> program = program_of(kind);
    ProgramSettings settings;
    settings.axes = 4;
    settings.letters = {'X', 'Y', 'Z', kind == slicer ? 'E' : 'A'};
    settings.dialect = kind == slicer ? Dialect::marlin : Dialect::linuxcnc;
    NoTable table;
    Expression expression(table);
    Interpreter<S> interpreter(settings, &expression);
    interpreter.start({});
    ProgramItem<S> item;
    bool right = interpreter.push("G1 F6000 X0 Y0", 1).ok();
    while (interpreter.next(item) == Pull::item) {
    }
    for (auto _ : state) {
        for (const std::string& text : program) {
            right = interpreter.push(text, 1).ok() && right;
            while (interpreter.next(item) == Pull::item) {
                benchmark::DoNotOptimize(item);
            }
        }
    }
    if (!right) {
        state.SkipWithError("a line was refused");
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(program.size()));
}

BENCHMARK_TEMPLATE(block, double)->ArgName("lines_slicer_arcs_expressions")->DenseRange(lines, expressions);
BENCHMARK_TEMPLATE(block, Fixed)->ArgName("lines_slicer_arcs_expressions")->DenseRange(lines, expressions);

} // namespace
