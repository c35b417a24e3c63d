// SPDX-License-Identifier: MIT
// Moves within a tolerance on a microcontroller: a hash over every Bezier point, which the host must print, too, and
// what corners, joints and points of chains cost. QEMU runs it with -icount shift=4: then instructions_now() counts in
// 64 instructions, and a call may take 42 million.
#include "instructions.hpp"
#include "integer_hash.hpp"
#include "splinefeed/s1_blended_path/tolerance_path.hpp"
#include "write_number.hpp"
#include "write_value.hpp"

#include <cstdint>
#include <new>

using namespace splinefeed;

namespace {

constexpr int axes = 3;
constexpr std::uint32_t instructions_a_count = 64;
constexpr std::int64_t half_pi = 1570796;

using Path = TolerancePath<Fixed>;
alignas(Path) unsigned char memory[sizeof(Path)];

/// Moves by number, in um.
struct Place {
    std::int64_t x = 0;
    std::int64_t y = 0;
};

PathElement<Fixed> line_to(Place place) {
    PathElement<Fixed> move;
    move.to[0] = position_from_um(place.x);
    move.to[1] = position_from_um(place.y);
    move.tolerance_mm = literal<Fixed>(0.01);
    return move;
}

// Sides of 10 mm, turning left and right by 90 degrees.
struct Corners {
    static constexpr const char* name = "corner";
    static constexpr unsigned moves = 41;
    static constexpr unsigned counted = 40;
    Place at;

    PathElement<Fixed> next(unsigned i) {
        (i % 2 == 0 ? at.x : at.y) += 10000;
        return line_to(at);
    }
};

// Lines of 10 mm and quarters of circles that go on in their direction, left and right.
struct Joints {
    static constexpr const char* name = "joint";
    static constexpr unsigned moves = 41;
    static constexpr unsigned counted = 40;
    Place at;

    PathElement<Fixed> next(unsigned i) {
        const bool left = i % 4 == 1;
        if (i % 2 == 0) {
            (i % 4 == 0 ? at.x : at.y) += 10000;
            return line_to(at);
        }
        const Place from = at;
        at.x += 10000;
        at.y += 10000;
        PathElement<Fixed> move = line_to(at);
        move.shape = MoveShape::arc;
        move.arc.centre[0] = position_from_um(left ? from.x : at.x);
        move.arc.centre[1] = position_from_um(left ? at.y : from.y);
        move.arc.normal[2] = from_integer<Fixed>(1);
        move.arc.sweep_rad = from_integer<Fixed>(left ? half_pi : -half_pi) / from_integer<Fixed>(1000000);
        return move;
    }
};

// Half a millimetre each, on arcs to both sides that turn by 2 degrees a point.
struct Chain {
    static constexpr const char* name = "chained_point";
    static constexpr unsigned moves = 400;
    static constexpr unsigned counted = 400;
    Place at;
    std::int64_t slope = 0;

    PathElement<Fixed> next(unsigned i) {
        slope += (i / 20) % 2 == 0 ? 20 : -20;
        at.x += 500;
        at.y += slope;
        return line_to(at);
    }
};

[[gnu::noinline]] void write_cost(const char* name, std::uint32_t counts, unsigned calls, std::uint32_t most) {
    write_text("cost ");
    write_text(name);
    write_text(" ");
    write_number((counts * instructions_a_count + calls / 2) / calls);
    write_text(" longest call ");
    write_number(most * instructions_a_count);
    write_text("\n");
}

template <class Moves>
void run() {
    auto& path = *new (memory) Path(axes, {literal<Fixed>(0.001)});
    Moves moves;
    IntegerHash hash;
    bool good = path.start({}).ok();
    unsigned pushed = 0;
    std::uint32_t counts = 0;
    std::uint32_t most = 0;
    CurveSegment<Fixed> segment;
    for (;;) {
        const std::uint32_t before = instructions_now();
        const Pull pull = path.next(segment);
        const std::uint32_t took = instructions_now() - before;
        counts += took;
        most = took > most ? took : most;
        if (pull == Pull::finished) {
            break;
        }
        if (pull == Pull::item) {
            for (unsigned k = 0; k < axes; ++k) {
                hash.add(static_cast<std::uint64_t>(segment.origin[k].raw));
                for (unsigned j = 0; j <= static_cast<unsigned>(segment.degree); ++j) {
                    hash.add(static_cast<std::uint64_t>(segment.control[k][j].raw()));
                }
            }
            continue;
        }
        const PathElement<Fixed> move = moves.next(pushed);
        const std::uint32_t start = instructions_now();
        good = (pushed < Moves::moves ? path.push(move) : path.finish()).ok() && good;
        counts += instructions_now() - start;
        ++pushed;
    }
    write_text("hash of ");
    write_text(Moves::name);
    write_value(good ? " " : " refused ", hash.value());
    write_cost(Moves::name, counts, Moves::counted, most);
}

} // namespace

int main() {
    start_counting();
    write_text("state ");
    write_number(sizeof(Path));
    write_text(" bytes\n");
    run<Corners>();
    run<Joints>();
    run<Chain>();
    return 0;
}
