#include "tests/measure/bench/curve_report.h"
#include "tests/measure/bench/xml_check.h"
#include "tests/measure/eval/report.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <limits>

namespace mfar::bench {
namespace {

using test::isWellFormed;

Curves twoCurves() {
    return {{"a<b", "c&d"},
            {{"flow2d", "steps", {{0, false, 10, 0.5, 0.2}, {4, true, 20.5, 0.25, 0.1}}},
             {"epipolar", "levels", {{3, true, 8, 0.2, 0.05}}}},
            {{"DIS fast", {0, false, 4, 0.4, 0.3}}}};
}

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
        ++n;
    return n;
}

TEST(CurvesCsv, HasARowForEveryKnobValueAndPeer) {
    EXPECT_EQ(curvesCsv(twoCurves()), "method,knob,value,default,ms,epe_px,bad1\n"
                                      "flow2d,steps,0,0,10.000,0.5000,0.200000\n"
                                      "flow2d,steps,4,1,20.500,0.2500,0.100000\n"
                                      "epipolar,levels,3,1,8.000,0.2000,0.050000\n"
                                      "DIS fast,,,,4.000,0.4000,0.300000\n");
}

TEST(CurvesSvg, IsXmlWithALineForEachKnob) {
    const std::string svg = curvesSvg(twoCurves());
    EXPECT_TRUE(isWellFormed(svg)) << svg;
    EXPECT_EQ(count(svg, "<polyline"), 2U);
    EXPECT_EQ(count(svg, "<title>"), 3U);
    EXPECT_EQ(count(svg, ">default<"), 2U);
    EXPECT_EQ(count(svg, ">DIS fast<"), 2U);  // one in each panel
    EXPECT_NE(svg.find("a&lt;b, c&amp;d"), std::string::npos);
}

TEST(CurvesSvg, LeavesOutInvalidPoints) {
    Curves curves = twoCurves();
    curves.curves[0].points[0].bad1 = std::numeric_limits<double>::quiet_NaN();
    curves.curves[0].points[1].ms = 0;
    curves.curves.pop_back();
    curves.peers.clear();
    const std::string svg = curvesSvg(curves);
    EXPECT_TRUE(isWellFormed(svg)) << svg;
    EXPECT_EQ(count(svg, "<title>"), 0U);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(WriteCurves, TheErrorNamesTheFileThatCannotBeWritten) {
    const mfar::test::TempFolder folder;
    mfar::test::writeFile(folder / "file", "");
    try {
        writeCurves(twoCurves(), folder / "file");
        FAIL() << "a file was accepted as the folder";
    } catch (const eval::EvalError& e) {
        EXPECT_NE(std::string(e.what()).find("curves.csv"), std::string::npos);
    }
}

TEST(IsWellFormed, RejectsMalformedXml) {
    EXPECT_TRUE(isWellFormed("<a b=\"1\"><c/><d>x &amp; y</d></a>\n"));
    for (const char* broken : {"", "<a>", "<a></b>", "<a b=1\"></a>", "<a>&</a>", "<a/><b></b><",
                               "<a><b></a></b>", "<a x=\"<\"></a>"})
        EXPECT_FALSE(isWellFormed(broken)) << broken;
}

}  // namespace
}  // namespace mfar::bench
