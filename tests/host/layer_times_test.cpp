// SPDX-License-Identifier: MIT
#include "host_sim/report/line_times.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;

namespace {

/// A tool that goes 0.1 mm in each millisecond.
struct Tool {
    LayerTimes layers;
    double height = 0.0;
    int ms = 0;

    void go(double rise_mm, int parts) {
        for (int i = 0; i < parts; ++i, ++ms) {
            layers.add(height, height + rise_mm, 0.1, 1e-3 * ms, 1e-3);
            height += rise_mm;
        }
    }
    void lift(double mm) { go(mm / 5.0, 5); }
};

} // namespace

TEST_CASE("a tall print: thousands of layers, each with its height and its begin") {
    Tool tool;
    constexpr int layers = 5000;
    for (int layer = 0; layer < layers; ++layer) {
        tool.lift(0.1);
        tool.go(0.0, 90);
    }
    const auto found = tool.layers.layers();
    REQUIRE(found.size() == layers);
    for (std::size_t i = 0; i < layers; i += 499) {
        CHECK(found[i].height_mm == Approx(0.1 * static_cast<double>(i + 1)));
        CHECK(found[i].start_s == Approx(0.095 * static_cast<double>(i) + 0.005));
    }
}

TEST_CASE("where the tool lifts between two places of a layer, and before the first one, there is no layer") {
    Tool tool;
    tool.lift(5.0);
    tool.go(0.0, 50); // to where it begins
    tool.lift(-4.8);
    for (int layer = 0; layer < 10; ++layer) {
        for (int place = 0; place < 5; ++place) {
            if (place > 0) {
                tool.lift(0.4);
                tool.go(0.0, 5);
                tool.lift(-0.4);
            }
            tool.go(0.0, 100);
        }
        tool.lift(0.2);
    }
    const auto found = tool.layers.layers();
    REQUIRE(found.size() == 10);
    CHECK(found[0].height_mm == Approx(0.2));
    CHECK(found[0].start_s == Approx(0.06));
    CHECK(found[9].height_mm == Approx(2.0));
}

TEST_CASE("what does not rise in layers has none") {
    Tool flat;
    flat.go(0.0, 10000);
    CHECK(flat.layers.layers().empty());

    Tool vase; // 0.1 mm a turn of 300 mm
    vase.go(0.1 / 3000.0, 100'000);
    CHECK(vase.layers.layers().empty());

    Tool one_by_one; // two objects, one after the other
    for (int object = 0; object < 2; ++object) {
        for (int layer = 0; layer < 20; ++layer) {
            one_by_one.go(0.0, 100);
            one_by_one.lift(0.2);
        }
        one_by_one.lift(-4.0);
    }
    CHECK(one_by_one.layers.layers().empty());

    Tool rounded; // its tops are level for one part each
    for (int wave = 0; wave < 100; ++wave) {
        rounded.lift(0.2);
        rounded.go(0.0, 1);
    }
    CHECK(rounded.layers.layers().empty());
}
