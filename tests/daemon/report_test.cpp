#include "base/line_chart.h"
#include "daemon/report.h"
#include "daemon/report_charts.h"
#include "daemon/status.h"
#include "daemon/thumbnail.h"
#include "hal/image_codec.h"
#include "tests/measure/bench/xml_check.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <string>

namespace mfar {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Adds `count` pictures 1/30 s apart. Every fifth is late. For every ten pictures, one more frame
/// is dropped.
void show(Stats& stats, int count) {
    stats.quality("lines-2", 25);
    for (int i = 0; i < count; ++i) {
        FrameStats frame;
        frame.usedStill = true;
        frame.meanConfidence = 0.8;
        const Timestamp arrived = Timestamp::fromSeconds(100 + i / 30.0);
        stats.mailboxDropped(static_cast<std::uint64_t>(i / 10));
        stats.framePose(i % 2 == 0 ? std::optional(Pose{}) : std::nullopt, {});
        const std::vector<StageTime> stages{{"flow", 12.0 + i % 3}, {"detail", 4}};
        stats.picture({frame, stages, arrived, arrived + std::chrono::milliseconds(21), 0.5,
                       i % 5 == 0 ? 30.0 : 20.0});
    }
}

RunDescription description() {
    return {
        "llvmpipe <6> & \"more\"", "synthetic:office", "none", "detail", {}, {}, "tags", "simd"};
}

std::string page(Stats& stats, const std::string& reason = "SIGTERM") {
    return reportPage(summary(stats.count(), description(), reason, 0), stats.history(),
                      stats.pictures(), "written today");
}

bool isWellFormed(const std::string& html) {
    const std::string doctype = "<!DOCTYPE html>\n";
    if (!html.starts_with(doctype)) return false;
    return bench::test::isWellFormed(html.substr(doctype.size()));
}

std::string cellOf(const std::string& html, const std::string& heading) {
    const std::string head = "<tr><th>" + heading + "</th><td>";
    const std::size_t at = html.find(head);
    if (at == std::string::npos) return "absent";
    const std::size_t begin = at + head.size();
    return html.substr(begin, html.find("</td>", begin) - begin);
}

TEST(Report, IsWellFormedAndNeedsNoOtherFile) {
    Stats stats;
    stats.keepHistory();
    show(stats, 300);
    const std::string html = page(stats, "error: <a> & b");
    EXPECT_TRUE(isWellFormed(html)) << html;
    EXPECT_THAT(html, HasSubstr("error: &lt;a&gt; &amp; b"));
    for (const char* outside : {"href=", "src=\"http", "<script", "@import", "url("})
        EXPECT_THAT(html, Not(HasSubstr(outside)));
}

TEST(Report, ThePageContainsTheNumbersOfTheSummary) {
    Stats stats;
    stats.keepHistory();
    show(stats, 300);
    const std::string html = page(stats);
    const auto json = summary(stats.count(), description(), "SIGTERM", 0);
    const auto shown = [](const nlohmann::ordered_json& value) {
        return fmt::format("{:.5g}", value.get<double>());
    };
    EXPECT_EQ(cellOf(html, "frames"), "300");
    EXPECT_EQ(cellOf(html, "late"), "60");
    EXPECT_EQ(cellOf(html, "mailbox"), "29");
    EXPECT_EQ(cellOf(html, "fps"), shown(json["fps"]));
    EXPECT_EQ(cellOf(html, "mean confidence"), shown(json["mean_confidence"]));
    EXPECT_EQ(cellOf(html, "tracked share"), "0.5");
    EXPECT_THAT(html,
                HasSubstr("<tr><th>flow</th><td>" + shown(json["stage_ms"]["flow"]["median"]) +
                          "</td><td>" + shown(json["stage_ms"]["flow"]["p99"]) + "</td></tr>"));
}

TEST(Report, NamesTheEngineOfEachStep) {
    Stats stats;
    RunDescription run = description();
    run.engine = "still gles, flow simd";
    const std::string html =
        reportPage(summary(stats.count(), run, "", 0), {}, {}, "written today");
    EXPECT_TRUE(isWellFormed(html)) << html;
    EXPECT_EQ(cellOf(html, "still"), "gles");
    EXPECT_EQ(cellOf(html, "flow"), "simd");
}

TEST(Report, ChartsShowTheValuesOfTheRun) {
    Stats stats;
    stats.keepHistory();
    show(stats, 300);
    const std::string html = page(stats);
    for (const char* title : {">Frame time [ms]<", ">deadline<", ">Late frames [%]<", ">dropped<",
                              ">tracked<", ">flow [ms]<", ">detail [ms]<", ">95 %<"})
        EXPECT_THAT(html, HasSubstr(title));
    for (const char* title : {"not recorded<", "not written<", "Learned filters"})
        EXPECT_THAT(html, Not(HasSubstr(std::string(">") + title)));
}

/// A history of 30 pictures at 30 Hz. A stall of `stallS` [s] with 150 dropped frames delays the
/// 16th picture and all later ones.
RunHistory historyWithStall(double stallS) {
    RunHistory history;
    for (int i = 0; i < 30; ++i) {
        RunMoment moment;
        moment.shown = Timestamp::fromSeconds(100 + i / 30.0 + (i < 15 ? 0 : stallS));
        moment.frameMs = moment.latencyMs = 10;
        moment.totals.notTaken = i < 15 ? 0 : 150;
        history.add(moment, {});
    }
    return history;
}

TEST(Report, DropsInAStallAreDividedByTheTimeOfTheStall) {
    const std::string hundreds = ">500</text>";
    EXPECT_THAT(runCharts(historyWithStall(0), 0), HasSubstr(hundreds))
        << "150 drops within 0.1 s are 1500 drops per second";
    EXPECT_THAT(runCharts(historyWithStall(5), 0), Not(HasSubstr(hundreds)))
        << "150 drops within 5 s are 30 drops per second";
}

TEST(Report, ARunWithoutPicturesHasNumbersOnly) {
    Stats stats;
    stats.keepHistory();
    const std::string html = page(stats, "error: no camera");
    EXPECT_TRUE(isWellFormed(html)) << html;
    EXPECT_EQ(cellOf(html, "frames"), "0");
    EXPECT_THAT(html, Not(HasSubstr("<svg")));
    EXPECT_THAT(html, Not(HasSubstr("<img")));
}

TEST(Report, ALongRunGivesAPageOfBoundedSize) {
    Stats stats;
    stats.keepHistory();
    show(stats, 100'000);
    const std::string html = page(stats);
    EXPECT_TRUE(isWellFormed(html));
    EXPECT_LT(html.size(), 300'000U);
    EXPECT_EQ(cellOf(html, "frames"), "100000");
}

TEST(Report, ThePageContainsThePicturesAsJpeg) {
    Stats stats;
    const std::vector<std::uint8_t> grey(std::size_t{2304} * 1728, 100);
    const std::vector<std::uint8_t> colour(std::size_t{8} * 6 * 4, 200);
    stats.pictures({thumbnail({colour.data(), {8, 6}, 32, PixelFormat::Rgba8}),
                    thumbnail({grey.data(), {2304, 1728}, 2304, PixelFormat::Gray8})});
    Size size;
    std::vector<std::uint8_t> pixels;
    decodeImage(stats.pictures().still, [&](Size of) -> PixelTarget {
        size = of;
        pixels.resize(std::size_t{4} * of.width * of.height);
        return {pixels.data(), std::size_t{4} * of.width};
    });
    EXPECT_EQ(size, (Size{640, 480}));
    EXPECT_NEAR(pixels[1000], 100, 2);
    const std::string html = page(stats);
    EXPECT_TRUE(isWellFormed(html));
    const std::string image = "src=\"data:image/jpeg;base64,/9j/";
    EXPECT_NE(html.find(image), html.rfind(image));
    EXPECT_LT(html.size(), 100'000U);
}

TEST(LineChart, TicksAreRoundAndWithinTheAxis) {
    EXPECT_EQ(linearTicks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
    EXPECT_EQ(linearTicks(-0.5, 0.9, 3), (std::vector<double>{-0.5, 0, 0.5}));
    EXPECT_TRUE(linearTicks(1, 1, 5).empty());
    EXPECT_TRUE(linearTicks(0, std::numeric_limits<double>::infinity(), 5).empty());
}

TEST(LineChart, GapsDivideALine) {
    const double gap = std::nan("");
    const std::string svg = chartSvg({"title", "x", {0, 1, 2, 3, 4}, {{"a", {1, 2, gap, 2, 1}}}});
    EXPECT_TRUE(bench::test::isWellFormed(svg)) << svg;
    const std::string line = "<polyline";
    EXPECT_NE(svg.find(line), svg.rfind(line));
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(LineChart, EmptyInfiniteAndExtremeValuesGiveAValidChart) {
    const double inf = std::numeric_limits<double>::infinity();
    for (const std::vector<double>& y : {std::vector<double>{}, {inf}, {0.0}, {-1.0}, {1e300}}) {
        const std::string svg = chartSvg({"<&>", "", {7}, {{"a", y}}, true, {}, {}});
        EXPECT_TRUE(bench::test::isWellFormed(svg)) << svg;
        EXPECT_THAT(svg, Not(HasSubstr("inf")));
        EXPECT_THAT(svg, Not(HasSubstr("nan")));
    }
}

}  // namespace
}  // namespace mfar
