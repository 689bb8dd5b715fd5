#include "tests/measure/eval/report.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace mfar::eval {
namespace {

Report twoFrames(const std::string& second) {
    Report report({{"ms", 1}, {"epe_px", 3}, {"later", 2}});
    report.add("a", "1", "x", {1.0, 0.5, std::nullopt});
    report.add(second, "2", "x", {3.0, 1.5, std::nullopt});
    report.addMeans();
    return report;
}

TEST(Report, CsvKeepsEveryColumnAndEndsWithTheMean) {
    EXPECT_EQ(twoFrames("a").csv(), "recording,frame,method,ms,epe_px,later\n"
                                    "a,1,x,1.000000,0.500000,\n"
                                    "a,2,x,3.000000,1.500000,\n"
                                    "a,mean,x,2.000000,1.000000,\n");
}

TEST(Report, WithSeveralRecordingsAMeanOverAllIsAdded) {
    const Report report = twoFrames("b");
    ASSERT_EQ(report.rows().size(), 5U);
    EXPECT_EQ(report.rows()[2].recording, "a");
    EXPECT_EQ(report.rows()[3].values[0], 3.0);
    EXPECT_EQ(report.rows()[4].recording, "all");
    EXPECT_EQ(report.rows()[4].frame, "mean");
    EXPECT_EQ(report.rows()[4].values[1], 1.0);
}

TEST(Report, MediansDoNotIncludeTheMeans) {
    Report report({{"ms", 1}});
    for (const double ms : {9.0, 1.0, 2.0})
        report.add("a", "1", "x", {ms});
    report.addMeans();
    report.addMedians();
    ASSERT_EQ(report.rows().size(), 5U);
    EXPECT_EQ(report.rows()[3].values[0], 4.0);
    EXPECT_EQ(report.rows()[4].frame, "median");
    EXPECT_EQ(report.rows()[4].values[0], 2.0);
}

TEST(Report, TableLeavesOutColumnsWithoutMeasurements) {
    EXPECT_EQ(twoFrames("a").table(), "recording  frame  method   ms  epe_px\n"
                                      "a          1      x       1.0   0.500\n"
                                      "a          2      x       3.0   1.500\n"
                                      "a          mean   x       2.0   1.000\n");
}

TEST(Report, HeadIsPrintedOnlyAboveTheTable) {
    Report report = twoFrames("a");
    const std::string table = report.table(), csv = report.csv();
    report.setHead("how to read it\n");
    EXPECT_EQ(report.table(), "how to read it\n" + table);
    EXPECT_EQ(report.csv(), csv);
}

TEST(Report, CsvQuotesNamesWithCommas) {
    Report report({{"ms", 1}});
    report.add("a,\"b\"", "1", "x", {1.0});
    EXPECT_NE(report.csv().find("\"a,\"\"b\"\"\",1,x"), std::string::npos);
}

TEST(Report, AnUnwritableFileIsAnError) {
    EXPECT_THROW(twoFrames("a").writeCsv(std::filesystem::path("/nonexistent/dir/x.csv")),
                 EvalError);
}

}  // namespace
}  // namespace mfar::eval
