// SPDX-License-Identifier: MIT
// The pulse train on a microcontroller: a hash over every step and edge, which the host must print, too, and what it
// costs.
#include "instructions.hpp"
#include "integer_hash.hpp"
#include "splinefeed/s5_pulse_train/pulse_train.hpp"
#include "write_number.hpp"
#include "write_value.hpp"

#include <cstdint>

using namespace splinefeed;

namespace {

constexpr int axes = 3;
constexpr unsigned segments = 120;
constexpr std::uint32_t tick_ticks = 80; // 10 us: 100 ticks a segment

/// Three axes that speed up to 45, 30 and 12 counts a segment of 1 ms and turn round twice, one after the other, as the
/// segment stream makes them: a uniform cubic B-spline.
class Program {
public:
    [[gnu::noinline]] bool next(FeedSegment& out) {
        if (index_ == segments) {
            return false;
        }
        out.index = index_;
        out.duration_ticks = 8000;
        for (unsigned k = 0; k < axes; ++k) {
            auto& c = control_[k];
            const int phase = static_cast<int>(index_ + 7 * k) % 80;
            const std::int64_t wish = index_ + 8 > segments ? 0 : (phase < 40 ? 1 : -1) * top_[k];
            const std::int64_t change = top_[k] / 8;
            velocity_[k] += wish > velocity_[k] + change   ? change
                            : wish < velocity_[k] - change ? -change
                                                           : wish - velocity_[k];
            c[0] = c[1], c[1] = c[2], c[2] = c[3];
            c[3] += index_ + 4 > segments ? 0 : velocity_[k];
            out.start[k] = c[0] + 4 * c[1] + c[2];
            out.end[k] = c[1] + 4 * c[2] + c[3];
            out.start_velocity[k] = 3 * (c[2] - c[0]);
            out.end_velocity[k] = 3 * (c[3] - c[1]);
        }
        ++index_;
        return true;
    }

private:
    static constexpr std::int64_t count = units_per_count / 6;
    std::int64_t top_[axes] = {45 * count, 30 * count + 12345, 12 * count - 678};
    std::int64_t velocity_[axes] = {};
    std::int64_t control_[axes][4] = {};
    unsigned index_ = 0;
};

class Hash : public IntegerHash {
public:
    [[gnu::noinline]] void add(std::int64_t tick, unsigned axis, bool a, bool b) {
        IntegerHash::add(static_cast<std::uint64_t>(tick));
        IntegerHash::add(axis * 4U + (a ? 2U : 0U) + (b ? 1U : 0U));
    }
};

/// Instructions and calls of one kind.
struct Cost {
    std::uint32_t instructions = 0;
    std::uint32_t calls = 0;
    std::uint32_t most = 0;

    template <class Call>
    void of(Call&& call) {
        const std::uint32_t before = instructions_now();
        call();
        const std::uint32_t took = instructions_now() - before;
        instructions += took;
        most = took > most ? took : most;
        ++calls;
    }
};

/// Measured empty, then with the calls: what a call costs, on average.
[[gnu::noinline]] void write_cost(const char* name, const Cost& cost, const Cost& empty) {
    const std::uint32_t overhead = empty.instructions / empty.calls;
    write_text("cost ");
    write_text(name);
    write_text(" ");
    write_number(cost.calls == 0 ? 0 : (cost.instructions + cost.calls / 2) / cost.calls - overhead);
    write_text(" most ");
    write_number(cost.most - overhead);
    write_text(" calls ");
    write_number(cost.calls);
    write_text("\n");
}

volatile std::uint32_t port;

constinit DdaLoader parts(axes, tick_ticks);
constinit TickDda<axes> dda;
TickPart part;
constinit StepIntervals intervals(axes);
constexpr Result<StepTiming> timing = StepTiming::make({});
constinit PulseTrain<StepIntervals> train(StepIntervals(axes), StepDirSequencer(axes, *timing));
FeedSegment segment;
Step step;
Edge edge;
bool more;

// What a timer's interrupt would do.
[[gnu::noinline]] void on_tick() {
    port = dda.tick().bits;
}
[[gnu::noinline]] void on_first_tick() {
    port = dda.begin(part).bits;
}

void run_ticks(const Cost& empty) {
    Program program;
    Hash hash;
    Cost take;
    Cost prepare;
    Cost first;
    Cost tick;
    std::int64_t now = 0;
    const auto see = [&] {
        hash.add(now, 0, false, false);
        hash.add(port, 0, false, false);
        ++now;
    };
    while (program.next(segment)) {
        take.of([] { parts.take(segment); });
        for (;;) {
            prepare.of([] { more = parts.next(part); });
            if (!more) {
                break;
            }
            first.of(on_first_tick);
            see();
            while (dda.left() > 0) {
                tick.of(on_tick);
                see();
            }
        }
    }
    write_value("hash of ticks    ", hash.value());
    write_cost("dda_tick", tick, empty);
    write_cost("dda_first_tick", first, empty);
    write_cost("dda_segment", take, empty);
    write_cost("dda_part", prepare, empty);
}

void run_intervals(const Cost& empty) {
    Program program;
    Hash hash;
    Cost take;
    Cost each;
    Cost none;
    while (program.next(segment)) {
        take.of([] { intervals.take(segment); });
        for (;;) {
            Cost one;
            one.of([] { more = intervals.next(step); });
            Cost& kind = more ? each : none;
            kind.instructions += one.instructions;
            kind.most = one.most > kind.most ? one.most : kind.most;
            ++kind.calls;
            if (!more) {
                break;
            }
            hash.add(step.tick, step.axis, step.up, false);
        }
    }
    write_value("hash of steps    ", hash.value());
    write_cost("interval_step", each, empty);
    write_cost("interval_segment", take, empty);
}

void run_edges(const Cost& empty) {
    Program program;
    Hash hash;
    Cost each;
    const auto drain = [&] {
        for (;;) {
            each.of([] { more = train.next(edge); });
            if (!more) {
                return;
            }
            hash.add(edge.tick, edge.axis, edge.line == Line::step, edge.level);
        }
    };
    while (program.next(segment)) {
        train.take(segment);
        drain();
    }
    train.finish();
    drain();
    write_value("hash of edges    ", hash.value());
    write_cost("edge_with_step", each, empty);
}

} // namespace

int main() {
    start_counting();
    Cost empty;
    for (int i = 0; i < 64; ++i) {
        empty.of([] {});
    }
    run_ticks(empty);
    run_intervals(empty);
    run_edges(empty);
    return 0;
}
