#include "tests/measure/bench/xml_check.h"
#include "tests/measure/eval/bars.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <string>

namespace mfar::eval {
namespace {

using testing::HasSubstr;
using testing::Not;

Report twoMethods(const std::vector<std::string>& recordings) {
    Report report({{"ms", 1}, {"never", 1}, {"psnr_db", 2}});
    for (const std::string& recording : recordings)
        for (const char* frame : {"1", "2"}) {
            report.add(recording, frame, "ours", {10, {}, 30});
            report.add(recording, frame, "bicubic", {2, {}, 28});
        }
    report.addMeans();
    report.addMedians();
    return report;
}

std::size_t occurrences(const std::string& text, const std::string& what) {
    std::size_t out = 0;
    for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1))
        ++out;
    return out;
}

TEST(Bars, EachMeasuredColumnOfAReportGetsAPanel) {
    const auto panels = barsOf(twoMethods({"office"}));
    ASSERT_EQ(panels.size(), 2U);
    EXPECT_EQ(panels[0].title, "ms");
    ASSERT_EQ(panels[1].bars.size(), 2U);
    EXPECT_EQ(panels[1].bars[0].label, "ours");
    EXPECT_EQ(panels[1].bars[0].value, 30);
    EXPECT_EQ(panels[1].bars[0].dots.size(), 2U) << "one dot for each frame";
}

TEST(Bars, MedianRowsThatACommandAddsGetNoDotAndNoPanel) {
    Report report = twoMethods({"office"});
    report.add("office", "median", "ours", {10, 7, 30});
    const auto panels = barsOf(report);
    ASSERT_EQ(panels.size(), 2U);
    EXPECT_EQ(panels[0].bars[0].dots.size(), 2U);
}

TEST(Bars, WithSeveralRecordingsEachDotIsTheMeanOfOneRecording) {
    const auto panels = barsOf(twoMethods({"office", "shelf", "outdoor"}));
    EXPECT_EQ(panels[0].bars[1].value, 2);
    EXPECT_EQ(panels[0].bars[1].dots.size(), 3U);
}

TEST(Bars, WithoutMeansEachRowGetsABar) {
    Report report({{"ms", 1}});
    report.add("a", "0", "x", {1});
    report.add("b", "0", "x", {std::nullopt});
    const auto panels = barsOf(report);
    ASSERT_EQ(panels[0].bars.size(), 2U);
    EXPECT_EQ(panels[0].bars[0].label, "a x");
    EXPECT_TRUE(std::isnan(panels[0].bars[1].value));
}

TEST(Bars, LengthsOfBarsAreProportionalToValues) {
    const std::string svg = barsSvg("", {{"t", {{"a", 10}, {"b", 5}}}}, "");
    const auto widthOf = [&](const char* colour) {
        const std::size_t end = svg.find(std::string("fill=\"") + colour);
        const std::size_t at = svg.rfind("width=\"", end) + 7;
        return std::stod(svg.substr(at));
    };
    const std::string second = barsSvg("", {{"t", {{"a", 10}, {"b", 5, {}, 1}}}}, "");
    EXPECT_EQ(occurrences(svg, "height=\"14\" fill="), 2U);
    EXPECT_GT(widthOf("#0072b2"), 100);
    const std::size_t b = second.find("fill=\"#d55e00\"");
    EXPECT_NEAR(std::stod(second.substr(second.rfind("width=\"", b) + 7)) * 2, widthOf("#0072b2"),
                0.2);
}

TEST(Bars, ValuesFarFromZeroAreDrawnAsPoints) {
    const std::string svg = barsSvg("", {{"psnr", {{"a", 30}, {"b", 28}}}}, "");
    EXPECT_EQ(occurrences(svg, "r=\"5\""), 2U);
    EXPECT_EQ(occurrences(svg, "height=\"14\" fill="), 0U);
}

TEST(Bars, SvgIsWellFormedForAnyTextsAndValues) {
    const double inf = std::numeric_limits<double>::infinity();
    const std::string svg =
        barsSvg("<&>",
                {{"a<b", {{"c&d", -3, {inf, 2}}, {"e", std::nan("")}, {"f", inf}}},
                 {"", {}},
                 {"zero", {{"g", 0}}}},
                "a<b>&c");
    EXPECT_TRUE(bench::test::isWellFormed(svg)) << svg;
    EXPECT_EQ(occurrences(svg, "not measured"), 2U);
    for (const char* word : {"nan", "inf"})
        EXPECT_THAT(svg, Not(HasSubstr(word)));
}

}  // namespace
}  // namespace mfar::eval
