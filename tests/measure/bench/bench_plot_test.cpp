#include "tests/measure/bench/bench_report.h"
#include "tests/measure/bench/governor_run.h"
#include "tests/measure/bench/skips.h"
#include "tests/measure/bench/xml_check.h"

#include <gmock/gmock.h>
#include <string>

namespace mfar::bench {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(BenchSvg, ShowsTheTimesOfCasesStagesAndPeers) {
    BenchResult result;
    result.renderer = "<llvmpipe>";
    result.cases = {{"moving", {20, 30, 18, 4}, {{"flow", {12, 14, 11, 4}}}, {}},
                    {"rest", {1, 2, 1, 4}, {}, {}}};
    result.peers = {{"paper", "moving", {50, 60, 45, 4}, 0.4, 0.3, 0.5}};
    const std::string svg = benchSvg(result);
    EXPECT_TRUE(test::isWellFormed(svg)) << svg;
    for (const char* text : {">moving<", ">moving, paper<", ">flow<", ">20.0<", ">50.0<",
                             ">moving, stages [ms]<", ">not measured<"})
        EXPECT_THAT(svg, HasSubstr(text));
}

TEST(SkipSvg, ShowsSavedTimeAndLostQualityOfEachCase) {
    SkipReport report;
    report.cases = {{"office", 20, 0, 0, 0.5}};
    report.results = {{"unchanged", "office", 15, 20, 0.05, {}, {}},
                      {"flat", "office", 20, 19, {}, {}, {}}};
    const std::string svg = skipSvg(report);
    EXPECT_TRUE(test::isWellFormed(svg)) << svg;
    for (const char* text : {">office: saved [ms]<", ">5.00<", ">-1.00<", ">0.050<"})
        EXPECT_THAT(svg, HasSubstr(text));
}

TEST(GovernorSvg, HasALineForEachSceneAndOneForTheDeadline) {
    const std::vector<GovernedRun> runs{{33, {{"office", {40, 30, 31}, {}}, {"still", {2, 2}, {}}}},
                                        {66, {}}};
    const std::string svg = governorSvg(runs);
    EXPECT_TRUE(test::isWellFormed(svg)) << svg;
    for (const char* text : {">deadline 33 ms", ">office<", ">still<", ">deadline<"})
        EXPECT_THAT(svg, HasSubstr(text));
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace mfar::bench
