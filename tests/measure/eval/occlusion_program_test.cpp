#include "tests/unit/run_program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace mfar::eval {
namespace {

using test::execute;
using test::Outcome;
using test::TempFolder;

Outcome evaluate(const TempFolder& folder, const std::string& arguments) {
    return execute(folder, fmt::format("'{}' occlusion {}", MFAR_EVAL, arguments));
}

TEST(MfarEvalOcclusion, WritesARowForEachFrameWithMeanAndMedian) {
    const TempFolder folder;
    test::writeFile(folder / "ball.toml", "[[objects]]\nshape = \"sphere\"\n"
                                          "position = [0.0, 0.1, 0.1]\n");
    const Outcome outcome = evaluate(
        folder, fmt::format("--scenes flat --paths rest --frames 2 --objects {0}/ball.toml --csv "
                            "{0}/out.csv",
                            folder.path().string()));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    std::istringstream in(test::readFile(folder / "out.csv"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);)
        lines.push_back(line);
    ASSERT_EQ(lines.size(), 1U + 2 + 2);
    EXPECT_EQ(lines[0], "recording,frame,method,depth_ms,composite_ms,iou,boundary_px,flicker");
    EXPECT_TRUE(lines[3].starts_with("flat/rest/sphere-1,mean,recorded,")) << lines[3];
    EXPECT_TRUE(lines[4].starts_with("flat/rest/sphere-1,median,recorded,")) << lines[4];
    std::istringstream row(lines[1]);
    std::vector<std::string> fields;
    for (std::string field; std::getline(row, field, ',');)
        fields.push_back(field);
    ASSERT_EQ(fields.size(), 8U);
    EXPECT_GT(std::stod(fields[5]), 0.5) << "no real thing hides the ball";
    EXPECT_LE(std::stod(fields[5]), 1);
    EXPECT_GE(std::stod(fields[7]), 0);
}

TEST(MfarEvalOcclusion, InvalidRequestsEndWithAMessageAndStatus2) {
    const TempFolder folder;
    test::writeFile(folder / "none.toml", "seed = 2\n");
    test::writeFile(folder / "wrong.toml", "[[objects]]\nshape = \"cone\"\n");
    const std::string dir = folder.path().string();
    const std::pair<std::string, std::string> cases[] = {
        {"--scenes attic", "unknown name 'attic'"},
        {"--paths office", "unknown name 'office'"},
        {"--scenes flat", "mfar-eval has no objects for scene flat"},
        {"--poses none", "without poses"},
        {"--objects " + dir + "/absent.toml", "cannot be read"},
        {"--objects " + dir + "/none.toml", "no [[objects]]"},
        {"--objects " + dir + "/wrong.toml", "wrong.toml:2:"},
        {"--frames 0", "--frames"},
        {"--noise nan", "--noise"},
    };
    for (const auto& [arguments, message] : cases) {
        const Outcome outcome = evaluate(folder, arguments);
        EXPECT_EQ(outcome.status, 2) << arguments;
        EXPECT_NE(outcome.text.find(message), std::string::npos) << outcome.text;
    }
}

}  // namespace
}  // namespace mfar::eval
