#include "tests/measure/bench/xml_check.h"
#include "tests/measure/eval/figure7_report.h"

#include <gtest/gtest.h>

namespace mfar::eval {
namespace {

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
        ++n;
    return n;
}

/// Scores that fall from each method to the next: Q by 10, and LPC-SI by 0.1.
Figure7Scene steps(const std::string& name, std::size_t frames) {
    Figure7Scene out{name, std::vector<std::string>(frames, "0"), {}};
    for (std::size_t m = 0; m < figure7Methods().size(); ++m) {
        PictureScores score;
        score.psnr = 30;
        score.hdrVdpQ = 100 - 10.0 * static_cast<double>(m);
        score.hdrVdpQMos = 50;
        score.lpcSi = 0.9 - 0.1 * static_cast<double>(m);
        score.tiles = {0.2, 0.3, 0.4};
        out.scores.emplace_back(frames, score);
    }
    return out;
}

const PictureMetrics kAsked{{"psnr", "lpc_si", "lpc_si_tiles", "hdrvdp"}, {}};

TEST(Figure7, SummaryComparesMfarWithTheOtherMethods) {
    EXPECT_EQ(
        figure7Summary({steps("desk", 2)}),
        "desk: HDR-VDP-2 Q 90.00 (+20.00 over the paper's method, +10.00 over the paper's blending "
        "on mfar's flow, +40.00 over bilinear); LPC-SI 0.8000 (-0.1000 from the truth's)\n");
}

TEST(Figure7, ReportHasEveryFrameAndTheMeans) {
    const Report report = figure7Report({steps("desk", 2)}, kAsked);
    ASSERT_EQ(report.rows().size(), 6U * 2 + 6);
    EXPECT_FALSE(report.rows()[0].values[0]);
    EXPECT_EQ(report.rows()[13].method, "detail");
    EXPECT_EQ(report.rows()[13].values[1], 90);
    EXPECT_NE(report.csv().find("hdrvdp_ppd"), std::string::npos);
}

TEST(Figure7, FigureHasABarForEveryMethodOfEveryScene) {
    Figure7Scene low = steps("a<b", 1);
    low.scores[5][0].hdrVdpQ = -30;
    const std::string svg = figure7Svg({steps("desk", 3), low}, kAsked);
    EXPECT_TRUE(bench::test::isWellFormed(svg)) << svg;
    EXPECT_EQ(count(svg, "<title>"), 2U * 2 * 6);
    EXPECT_EQ(count(svg, "<circle"), 2U * 6 * (3 + 1));
    EXPECT_EQ(count(svg, ">-40<"), 1U);  // the axis extends below the lowest value
    EXPECT_NE(svg.find("30 pixels per degree"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace mfar::eval
