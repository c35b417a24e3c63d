// SPDX-License-Identifier: MIT
#include "splinefeed/hal/base/edit_distance.hpp"
#include "support/catch.hpp"

using splinefeed::hal::edit_distance;

TEST_CASE("Edit distance: letters to insert, delete, replace and swap; case is free") {
    CHECK(edit_distance("", "") == 0);
    CHECK(edit_distance("", "abc") == 3);
    CHECK(edit_distance("abc", "") == 3);
    CHECK(edit_distance("X_STEP", "x_step") == 0);
    CHECK(edit_distance("X_STEP", "X_STP") == 1);
    CHECK(edit_distance("X_STEP", "X_STEEP") == 1);
    CHECK(edit_distance("X_STEP", "Y_STEP") == 1);
    CHECK(edit_distance("X_STEP", "X_SETP") == 1);
    CHECK(edit_distance("kitten", "sitting") == 3);
    CHECK(edit_distance("ca", "abc") == 3); // no letter is edited twice
}
