// SPDX-License-Identifier: MIT
// Any lines, in any dialect, with and without expressions: the interpreter takes or refuses each without harm, a
// refused line changes nothing, a block ends after a bounded number of items, moves join, and stay in the machine's
// range. So it is, too, where refused lines are obeyed, to find further errors.
#include "splinefeed/s0_program/cycles/spline_points.hpp"
#include "splinefeed/s0_program/expression.hpp"
#include "splinefeed/s0_program/interpreter.hpp"
#include "splinefeed/s0_program/words/fanuc_words.hpp"

#include "fuzz/bytes.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

using namespace splinefeed;

namespace {

class Table final : public ParameterTable {
public:
    [[nodiscard]] bool read(std::int32_t number, Decimal& out) const noexcept override {
        const bool known = number >= 1 && number <= 30;
        out = known ? values_[static_cast<unsigned>(number - 1)] : Decimal{};
        return known;
    }
    bool write(std::int32_t number, Decimal value) noexcept override {
        if (number < 1 || number > 30) {
            return false;
        }
        values_[static_cast<unsigned>(number - 1)] = value;
        return true;
    }
    void forget(std::int32_t number) noexcept override { write(number, {}); }
    [[nodiscard]] bool read(std::string_view name, Decimal& out) const noexcept override {
        return read(static_cast<std::int32_t>(name.size()), out);
    }
    bool write(std::string_view name, Decimal value) noexcept override {
        return write(static_cast<std::int32_t>(name.size()), value);
    }
    void forget(std::string_view name) noexcept override { forget(static_cast<std::int32_t>(name.size())); }

private:
    std::array<Decimal, 30> values_{};
};

class Tools final : public ToolTable {
public:
    [[nodiscard]] bool find(std::int32_t tool, ToolOffset& out) const noexcept override {
        out = {};
        out.offset[0] = Decimal::from_integer(tool);
        return tool < 100;
    }
};

[[noreturn]] void fail(const char* what, const std::string& line) {
    std::fprintf(stderr, "%s: %s\n", what, line.c_str());
    std::abort();
}

// Of a message or of M117, and within its own line.
void check_text(const ProgramEvent& event, const std::string& line) {
    const std::string text(event.text.of(line));
    const bool has_text = event.kind == EventKind::message || event.kind == EventKind::print ||
                          event.kind == EventKind::debug || (event.kind == EventKind::printer && event.number == 117);
    if (text.size() != event.text.size || (!has_text && !text.empty())) {
        fail("a text that is not the event's", line);
    }
}

template <Scalar S>
void run(std::string_view text, const ProgramSettings& given_settings, bool evaluates, bool obeys) {
    constexpr int most_items = 400'000; // of pecks and repeats; more would only take time
    Table table;
    Expression expression(table);
    SplinePoints<S> points;
    std::array<WorkSystem, 3> further{};
    FanucWords words(further);
    ProgramSettings settings = given_settings;
    settings.extension = settings.dialect == Dialect::fanuc && evaluates ? &words : nullptr;
    Interpreter<S> interpreter(settings, evaluates ? &expression : nullptr, &points);
    interpreter.start({});
    ProgramItem<S> item;
    PerAxis<Position> at = interpreter.position(); // where the moves so far end
    PerAxis<Position> stands = at;                 // the program
    std::uint32_t number = 0;
    int items = 0;
    while (!text.empty() && items < most_items) {
        const std::size_t end = text.find('\n');
        const std::string line(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        const WorkOffsets offsets = interpreter.offsets();
        const ModalState modal = interpreter.modal();
        const WorkSystem* const system = words.system();
        const std::array<WorkSystem, 3> origins = further;
        const bool moved = words.moves_program();
        std::vector<char> given(line.begin(), line.end()); // freed behind the call: nothing may refer to it then
        const BlockStatus status = interpreter.push({given.data(), given.size()}, ++number);
        if (!status.ok()) {
            if (status.column > line.size() + 1 || describe(status.error) == std::string("unknown error")) {
                fail("a place or an error that is none", line);
            }
            if (!(interpreter.offsets() == offsets) || !(interpreter.modal() == modal) ||
                interpreter.position() != stands || words.system() != system || further != origins ||
                words.moves_program() != moved) {
                fail("a refused line changed something", line);
            }
            if (obeys) {
                interpreter.obey_refused();
                at = stands = interpreter.position();
            }
            continue;
        }
        given = {};
        Pull pull = Pull::item;
        while ((pull = interpreter.next(item)) == Pull::item && ++items < most_items) {
            if (item.kind == ItemKind::event) {
                check_text(item.event, line);
            }
            if (item.kind != ItemKind::move) {
                continue;
            }
            for (const unsigned k : indices(settings.axes)) {
                if (std::abs(item.element.to[k].raw) > std::int64_t{1} << 60 ||
                    std::abs(item.element.to[k].raw - at[k].raw) > std::int64_t{65537} << 40) {
                    fail("a move out of range", line);
                }
            }
            if (!(item.element.feed_mm_s >= S{})) {
                fail("a feed below 0", line);
            }
            at = item.element.to;
        }
        stands = interpreter.position();
        const bool in_nurbs = interpreter.modal().motion == 52;
        if (interpreter.has_curve()) { // of which some points are known only
            continue;
        }
        if (pull != Pull::item && !in_nurbs && at != interpreter.position()) {
            fail("the moves end elsewhere", line);
        }
        at = in_nurbs && pull != Pull::item ? at : interpreter.position();
        if (in_nurbs) {
            at = interpreter.position(); // of the program: it stands at the curve's start
        }
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    splinefeed_test::Bytes bytes{data, size};
    const unsigned choice = bytes.take();
    const Tools tools;
    ProgramSettings settings;
    settings.axes = 4;
    settings.letters = {'X', 'Y', 'Z', 'A'};
    settings.dialect = static_cast<Dialect>(choice % 5);
    settings.letters[3] = rules_of(settings.dialect).extruder ? 'E' : 'A';
    settings.ignores_unknown = (choice & 64U) != 0;
    settings.increments = (choice & 128U) != 0;
    settings.block_delete = (choice & 4U) != 0;
    settings.tools = (choice & 8U) != 0 ? &tools : nullptr;
    const std::string text(reinterpret_cast<const char*>(bytes.data), bytes.left);
    const bool evaluates = (choice & 16U) == 0;
    for (const bool obeys : {false, true}) {
        if ((choice & 32U) != 0) {
            run<Fixed>(text, settings, evaluates, obeys);
        } else {
            run<double>(text, settings, evaluates, obeys);
        }
    }
    return 0;
}
