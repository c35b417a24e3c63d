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

TEST_CASE("a long piece of work waits for a call of its own, and is done there however small the budget is", "[work]") {
    WorkBudget rest(3);
    CHECK(rest.take());
    CHECK_FALSE(rest.take(3));
    CHECK(rest.spent()); // nothing else comes first
    WorkBudget small(1);
    CHECK(small.take(3));
    CHECK(small.spent());
    WorkBudget begun(1);
    begun.charge();
    CHECK_FALSE(begun.take()); // something was done already
    WorkBudget enough(4);
    CHECK(enough.take());
    CHECK(enough.take(3));
    CHECK(enough.spent());
}

TEST_CASE("an unlimited budget does not end", "[work]") {
    WorkBudget budget;
    for (int i = 0; i < 1'000'000; ++i) {
        budget.charge();
    }
    CHECK(budget.take());
    CHECK_FALSE(budget.spent());
}
