#include "tests/measure/bench/skips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace mfar::bench {
namespace {

SkipReport twoSkips() {
    return {{{"still", 1.5, 0, 0, 0}, {"office", 100, 300, 20, 0.98}},
            {{"tiles", "still", 1.5, 90, 0.0, {}, {}},
             {"tiles", "office", 100, 101, 0.2, {}, {}},
             {"objects", "office", 100, 120, -0.05, 0.05, -0.3}}};
}

TEST(SkipReport, CsvHasALineForEachResult) {
    EXPECT_EQ(skipCsv(twoSkips()),
              "case,skip,ms,ms_without,saved_ms,psnr_lost_db,bad1_added,overlap_lost\n"
              "still,tiles,1.500,90.000,88.500,0.00000,,\n"
              "office,tiles,100.000,101.000,1.000,0.20000,,\n"
              "office,objects,100.000,120.000,20.000,-0.05000,0.05000,-0.30000\n");
}

TEST(SkipReport, TableNamesSkipsThatSaveTimeAndSkipsThatLoseTooMuchAccuracy) {
    const std::string table = skipTable(twoSkips());
    EXPECT_NE(
        table.find("tiles                saves time in these cases: still; loses more than 0.1 dB "
                   "or 0.1 percentage points in these cases: office\n"),
        std::string::npos)
        << table;
    EXPECT_NE(table.find("objects              saves time in these cases: office\n"),
              std::string::npos)
        << table;
    EXPECT_EQ(std::count(table.begin(), table.end(), '!'), 1);
}

TEST(SkipReport, SkipsThatSaveNoTimeAreListed) {
    SkipReport report = twoSkips();
    report.results.resize(1);
    report.results[0].msWithout = 1.51;
    EXPECT_NE(skipTable(report).find("tiles                saves time in no case\n"),
              std::string::npos);
}

}  // namespace
}  // namespace mfar::bench
