// SPDX-License-Identifier: MIT
#include "host_sim/output/place_text.hpp"
#include "support/catch.hpp"

using splinefeed::host::PlaceText;

TEST_CASE("Place text: axes with their places, and which of them nobody has heard") {
    PlaceText place;
    place.add("x", 1.0);
    place.add("y", -2.00004, false);
    CHECK(place.text() == "; the machine stands at x=1.0000 y=-2.0000 (when it was last heard) mm");
    PlaceText exact("; last steps to", 6);
    exact.add("z", 0.5);
    CHECK(exact.text() == "; last steps to z=0.500000 mm");
}

TEST_CASE("Place text: nothing is claimed about an axis whose place is not known") {
    PlaceText place;
    place.add("x", std::nullopt);
    CHECK(place.text() == "; where the machine stands is not known (find the references again)");
    place.add("y", 2.0);
    CHECK(place.text() ==
          "; the machine stands at y=2.0000 mm; where x stands is not known (find its reference again)");
    place.add("z", std::nullopt, false);
    CHECK(place.text() ==
          "; the machine stands at y=2.0000 mm; where x, z stand is not known (find their references again)");
}
