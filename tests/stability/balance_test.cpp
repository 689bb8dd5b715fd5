#include "tests/stability/balance.h"

#include <gtest/gtest.h>

#include <string_view>

namespace mfar::stress {
namespace {

constexpr long kEnough = 1000;

std::vector<Case> twoCases() {
    std::vector<Case> out;
    for (const Case& one : allCases())
        if (one.atProductSize && out.size() < 2) out.push_back(one);
    return out;
}

std::string_view nextOf(const Balance& balance, const Checks& checks) {
    const Case* next = balance.next(checks, kEnough);
    return next == nullptr ? "" : next->name;
}

TEST(Balance, TheFastestCaseIsChosenForThePassWithTheFewestPixels) {
    const auto cases = twoCases();
    Balance balance(cases);
    Checks checks;
    EXPECT_EQ(nextOf(balance, checks), cases[0].name) << "each case is run once first";
    balance.ran(cases[0], {}, {{"a", 100}, {"b", 10}}, 1, Scale::Product);
    EXPECT_EQ(nextOf(balance, checks), cases[1].name);
    balance.ran(cases[1], {}, {{"a", 20}, {"b", 20}}, 1, Scale::Product);
    checks.through("a", 120);
    checks.through("b", 130);
    EXPECT_EQ(nextOf(balance, checks), cases[0].name);
    checks.through("a", 20);
    EXPECT_EQ(nextOf(balance, checks), cases[1].name);
    checks.through("a", kEnough);
    checks.through("b", kEnough);
    EXPECT_EQ(nextOf(balance, checks), "");
}

TEST(Balance, CasesThatReachedAPassOnlyWithSmallPicturesRunForALimitedTime) {
    const auto cases = twoCases();
    Balance balance(cases);
    Checks checks;
    balance.ran(cases[0], {}, {{"a", 100}}, 1, Scale::Product);
    balance.ran(cases[1], {}, {{"a", 100}}, 1, Scale::Product);
    balance.ran(cases[1], {}, {{"rare", 5}}, 1, Scale::Tests);
    checks.through("a", 200);
    checks.through("rare", 5);
    EXPECT_EQ(nextOf(balance, checks), cases[1].name);
    balance.ran(cases[1], {}, {{"a", 500}}, 100, Scale::Product);
    EXPECT_EQ(nextOf(balance, checks), cases[0].name) << "the case did not reach the pass in time";
}

}  // namespace
}  // namespace mfar::stress
