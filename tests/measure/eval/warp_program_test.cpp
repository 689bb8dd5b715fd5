#include "tests/measure/bench/xml_check.h"
#include "tests/unit/run_program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace mfar::eval {
namespace {

using test::execute;
using test::TempFolder;

TEST(MfarEvalWarp, WritesARowForEachAngleAndMethodAndAPlot) {
    const TempFolder folder;
    const auto outcome =
        execute(folder, fmt::format("'{0}' warp --scenes still-life --width 64 --height 48 "
                                    "--samples 4 --truth-samples 8 --hole-samples 2 --degrees 2,20 "
                                    "--csv {1}/out.csv --svg {1}/out.svg",
                                    MFAR_EVAL, folder.path().string()));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    std::istringstream in(test::readFile(folder / "out.csv"));
    std::string line;
    std::getline(in, line);
    EXPECT_EQ(line, "recording,frame,method,psnr_db,hole_share,reray_share,reray_of_objects,ms");
    int rows = 0;
    for (; std::getline(in, line); ++rows) {
        EXPECT_TRUE(line.starts_with(rows < 6 ? "still-life/2,0," : "still-life/20,0,")) << line;
        EXPECT_EQ(line.find("nan"), std::string::npos) << line;
    }
    EXPECT_EQ(rows, 2 * 6);
    EXPECT_TRUE(bench::test::isWellFormed(test::readFile(folder / "out.svg")));
}

TEST(MfarEvalWarp, InvalidRequestsEndWithStatus2) {
    const TempFolder folder;
    for (const char* arguments : {"--scenes absent", "--methods magic", "--degrees nan",
                                  "--degrees 0", "--samples 0", "--width 100000"}) {
        const auto outcome = execute(folder, fmt::format("'{}' warp {}", MFAR_EVAL, arguments));
        EXPECT_EQ(outcome.status, 2) << arguments << outcome.text;
    }
}

}  // namespace
}  // namespace mfar::eval
