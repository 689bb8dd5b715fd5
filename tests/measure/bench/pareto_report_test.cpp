#include "tests/measure/bench/pareto.h"
#include "tests/measure/bench/xml_check.h"

#include <gtest/gtest.h>

#include <limits>

namespace mfar::bench {
namespace {

using Kind = ParetoPoint::Kind;

ParetoStage fivePoints() {
    return {"flow",
            "bad-1 [%]",
            "a<b",
            {{"slow", Kind::Ours, 20, 5},
             {"usual", Kind::Default, 10, 4},
             {"quick", Kind::Ours, 2, 30},
             {"peer", Kind::Peer, 3, 20},
             {"slow peer", Kind::Peer, 15, 4.5}}};
}

TEST(Pareto, APointDominatesSlowerOrLessAccurateOnes) {
    const ParetoPoint a{"a", Kind::Ours, 1, 1};
    EXPECT_TRUE(dominates(a, {"b", Kind::Ours, 2, 1}));
    EXPECT_TRUE(dominates(a, {"b", Kind::Ours, 1, 2}));
    EXPECT_FALSE(dominates(a, a));
    EXPECT_FALSE(dominates(a, {"b", Kind::Ours, 0.5, 2}));
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(dominates(a, {"b", Kind::Ours, kNan, 2}));
    EXPECT_FALSE(dominates({"b", Kind::Ours, 0, kNan}, a));
}

TEST(Pareto, FrontHoldsUndominatedPointsFromFastToAccurate) {
    const ParetoStage stage = fivePoints();
    EXPECT_EQ(paretoFront(stage.points), (std::vector<std::size_t>{2, 3, 1}));
    auto broken = stage.points;
    broken[2].error = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(paretoFront(broken), (std::vector<std::size_t>{3, 1}));
}

TEST(Pareto, SummaryNamesThePeersThatDominateAPoint) {
    const ParetoStage stage = fivePoints();
    EXPECT_EQ(dominatingPeers(stage, stage.points[0]), std::vector<std::string>{"slow peer"});
    EXPECT_TRUE(dominatingPeers(stage, stage.points[1]).empty());
    const std::string text = paretoSummary({stage});
    const auto at = [&](const char* what) { return text.find(what); };
    EXPECT_LT(at("none of the other methods dominates"), at("usual"));
    EXPECT_LT(at("quick"), at(" one of the other methods dominates"));
    EXPECT_LT(at(" one of the other methods dominates"), at("dominated by slow peer"));
}

TEST(Pareto, CsvHasALineForEachPoint) {
    EXPECT_EQ(paretoCsv({fivePoints()}), "stage,name,kind,ms,error,measure,front,dominated_by\n"
                                         "flow,slow,ours,20.000,5.00000,bad-1 [%],0,slow peer\n"
                                         "flow,usual,default,10.000,4.00000,bad-1 [%],1,\n"
                                         "flow,quick,ours,2.000,30.00000,bad-1 [%],1,\n"
                                         "flow,peer,peer,3.000,20.00000,bad-1 [%],1,\n"
                                         "flow,slow peer,peer,15.000,4.50000,bad-1 [%],0,\n");
}

TEST(Pareto, SvgIsXmlWithAMarkForEachPoint) {
    ParetoStage stage = fivePoints();
    stage.points.push_back({"broken", Kind::Ours, 0, std::numeric_limits<double>::infinity()});
    stage.points.push_back({"perfect", Kind::Ours, 30, 0});
    const std::string svg = paretoSvg({stage, {"empty", "", "", {}}});
    EXPECT_TRUE(test::isWellFormed(svg)) << svg;
    std::size_t marks = 0;
    for (std::size_t at = svg.find("<title>"); at != std::string::npos;
         at = svg.find("<title>", at + 1))
        ++marks;
    EXPECT_EQ(marks, 6U);
    EXPECT_NE(svg.find("a&lt;b"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace mfar::bench
