#include "tests/measure/bench/xml_check.h"
#include "tests/measure/eval/plot.h"
#include "tests/measure/eval/report.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace mfar::eval {
namespace {

PlotPanel twoLines() {
    PlotPanel out;
    out.title = "a<b";
    out.xLabel = "c&d";
    out.lines = {{"steep", {{1, 100, "first", "1"}, {10, 1, "last", "10"}}},
                 {"flat", {{1, 10, "x", ""}, {100, 10, "y", ""}}}};
    return out;
}

std::vector<std::pair<double, double>> polyline(const std::string& svg, int which) {
    const std::string begin = "polyline points=\"";
    std::size_t at = 0;
    for (int i = 0; i <= which; ++i) {
        at = svg.find(begin, at);
        if (at == std::string::npos) return {};
        at += begin.size();
    }
    std::vector<std::pair<double, double>> out;
    double x = 0, y = 0;
    char comma = 0;
    for (std::istringstream in(svg.substr(at, svg.find('"', at) - at)); in >> x >> comma >> y;)
        out.emplace_back(x, y);
    return out;
}

TEST(PlotSvg, IsWellFormedForAnyTexts) {
    EXPECT_TRUE(bench::test::isWellFormed(plotSvg("<&>", {twoLines(), twoLines()}, "a<b>&c")));
    EXPECT_TRUE(bench::test::isWellFormed(plotSvg("", {}, "")));
}

TEST(PlotSvg, PutsPointsOnLogarithmicAxes) {
    const std::string svg = plotSvg("", {twoLines()}, "");
    const auto steep = polyline(svg, 0), flat = polyline(svg, 1);
    ASSERT_EQ(steep.size(), 2U);
    ASSERT_EQ(flat.size(), 2U);
    EXPECT_EQ(flat[0].second, flat[1].second);
    EXPECT_EQ(flat[0].first, steep[0].first);
    EXPECT_NEAR(steep[1].first, (flat[0].first + flat[1].first) / 2, 0.2) << "x = 10 lies midway";
    EXPECT_NEAR(flat[0].second, (steep[0].second + steep[1].second) / 2, 0.2);
    EXPECT_LT(steep[0].second, steep[1].second) << "larger y are further up";
}

TEST(PlotSvg, LeavesOutInvalidPoints) {
    PlotPanel panel = twoLines();
    panel.lines[0].points = {{0, 1, "", ""},
                             {std::nan(""), 1, "", ""},
                             {1, std::numeric_limits<double>::infinity(), "", ""},
                             {1, -1, "", ""},
                             {5, 0, "", ""}};
    panel.leastY = 0.1;
    panel.ringed = PlotPoint{std::nan(""), 1, "", ""};
    const std::string svg = plotSvg("", {panel}, "");
    EXPECT_EQ(polyline(svg, 0).size(), 1U) << "y = 0 is drawn at leastY";
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(WriteText, TheErrorNamesTheFileThatCannotBeWritten) {
    const mfar::test::TempFolder folder;
    writeText(folder / "plot.svg", "<svg/>");
    EXPECT_EQ(mfar::test::readFile(folder / "plot.svg"), "<svg/>");
    try {
        writeText(folder / "absent" / "plot.svg", "<svg/>");
        FAIL() << "the folder does not exist";
    } catch (const EvalError& e) {
        EXPECT_NE(std::string(e.what()).find("plot.svg"), std::string::npos);
    }
}

}  // namespace
}  // namespace mfar::eval
