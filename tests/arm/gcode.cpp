// SPDX-License-Identifier: MIT
// The G-code interpreter on a microcontroller: a hash over every item of a program, which the host must print, too, and
// what a block costs.
#include "instructions.hpp"
#include "integer_hash.hpp"
#include "splinefeed/s0_program/interpreter.hpp"
#include "write_value.hpp"

#include <cstdint>

using namespace splinefeed;

namespace {

using namespace std::string_view_literals;

constexpr std::string_view program[] = {
    "G21 G90 G17 G64 P0.01 F6000 (a program with each kind of block)"sv,
    "G0 X10.5 Y-3.25 Z5"sv,
    "G1 X12.345 Y6.789 Z0.125"sv,
    "X13.001 Y7.002"sv,
    "X13.503 Y7.125 Z-0.031"sv,
    "G2 X20 Y7.125 I3.25 J0"sv,
    "G3 X30 Y10 R20"sv,
    "G3 I-5 Z-1 P2"sv,
    "G18 G2 X35 Z4 R6"sv,
    "G17 G20 G91 G1 X0.1 Y-0.2"sv,
    "G21 G90 G10 L2 P2 X1 Y2 R30"sv,
    "G55 G1 X1 Y1"sv,
    "G2 X3 Y3 I1 J1"sv,
    "G54 G99 G81 X10 Y10 Z-4 R1 L2"sv,
    "G83 X20 Z-3 R1 Q0.75"sv,
    "G80"sv,
    "G5 X40 Y0 I3 J4 P-5 Q6"sv,
    "G5.2 X50 Y10 P2 L4"sv,
    "X60 Y0 P1"sv,
    "X70 Y10 P0.5"sv,
    "X80 Y0 P1"sv,
    "G5.3"sv,
    "G93 G1 X1 Y2 F30"sv,
    "G94 M3 S1000 M8 F500"sv,
    "M62 P3 G1 X5"sv,
    "G4 P0.25"sv,
    "G28 Z1"sv,
    "M30"sv,
};

class Hash : public IntegerHash {
public:
    [[gnu::noinline]] void add(std::int64_t number) { IntegerHash::add(static_cast<std::uint64_t>(number)); }
};

void add_item(Hash& hash, const ProgramItem<Fixed>& item) {
    hash.add(static_cast<std::int64_t>(item.kind) * 256 + item.line);
    if (item.kind == ItemKind::dwell) {
        hash.add(item.dwell_s.raw);
    } else if (item.kind == ItemKind::event) {
        hash.add(static_cast<std::int64_t>(item.event.kind) * 256 + item.event.number);
        hash.add(item.event.value.raw);
    } else {
        const PathElement<Fixed>& element = item.element;
        hash.add(static_cast<std::int64_t>(element.shape));
        hash.add(element.feed_mm_s.raw());
        for (unsigned k = 0; k < 3; ++k) {
            hash.add(element.to[k].raw);
            for (unsigned i = 0; element.shape == MoveShape::bezier && i < 6; ++i) {
                hash.add(element.bezier.points[k][i].raw());
            }
            if (element.shape == MoveShape::arc) {
                hash.add(element.arc.centre[k].raw);
                hash.add(element.arc.normal[k].raw());
            }
        }
        hash.add(element.shape == MoveShape::arc ? element.arc.sweep_rad.raw() : 0);
    }
}

constexpr ProgramSettings settings;
ProgramItem<Fixed> item;

} // namespace

int main() {
    static Interpreter<Fixed> interpreter(settings);
    interpreter.start({});
    Hash hash;
    std::uint32_t number = 0;
    std::uint32_t items = 0;
    std::uint32_t all = 0;
    start_counting();
    for (const std::string_view text : program) {
        std::uint32_t before = instructions_now();
        const BlockStatus status = interpreter.push(text, ++number);
        Pull pull = interpreter.next(item);
        std::uint32_t took = instructions_now() - before;
        hash.add(static_cast<std::int64_t>(status.error));
        while (pull == Pull::item) {
            ++items;
            add_item(hash, item);
            pull = interpreter.next(item);
        }
        all += took;
        write_text(text.data());
        write_value("\ncost", took);
    }
    write_value("items", items);
    write_value("hash", hash.value());
    write_value("cost of all", all);
    write_value("bytes of RAM", sizeof interpreter);
    return 0;
}
