// SPDX-License-Identifier: MIT
#include "splinefeed/base/work_budget.hpp"

#include "support/catch.hpp"

using splinefeed::WorkBudget;

TEST_CASE("a budget gives as many steps as it has", "[work]") {
    WorkBudget budget(3);
    CHECK(budget.take());
    CHECK(budget.take());
    CHECK_FALSE(budget.spent());
    CHECK(budget.take());
    CHECK(budget.spent());
    CHECK_FALSE(budget.take());
    CHECK_FALSE(budget.take());
}

TEST_CASE("what is done in any case counts, and never below zero", "[work]") {
    WorkBudget budget(2);
    budget.charge();
    CHECK(budget.take());
    budget.charge();
    budget.charge();
    CHECK(budget.spent());
    CHECK_FALSE(budget.take());
}

TEST_CASE("an unlimited budget does not end", "[work]") {
    WorkBudget budget;
    for (int i = 0; i < 1'000'000; ++i) {
        budget.charge();
    }
    CHECK(budget.take());
    CHECK_FALSE(budget.spent());
}
