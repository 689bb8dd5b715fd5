#include "daemon/quality_table.h"
#include "tests/measure/bench/xml_check.h"
#include "tests/unit/temp_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace mfar::bench {
namespace {

TEST(MfarBench, QuickRunWritesEveryPartOfItsJson) {
    const mfar::test::TempFolder folder;
    const auto file = folder / "bench.json", svg = folder / "bench.svg";
    const std::string command = fmt::format("{} --quick --json '{}' --svg '{}' >/dev/null",
                                            MFAR_BENCH, file.string(), svg.string());
    ASSERT_EQ(std::system(command.c_str()), 0);
    EXPECT_TRUE(test::isWellFormed(mfar::test::readFile(svg)));
    const auto result = nlohmann::json::parse(mfar::test::readFile(file));
    for (const char* key : {"workload", "renderer", "opencv", "opencv_threads", "set_still"})
        EXPECT_TRUE(result.contains(key)) << key;
    EXPECT_EQ(result.at("output"), nlohmann::json({576, 432}));
    ASSERT_EQ(result.at("cases").size(), 4U);
    const char* names[] = {"moving", "handheld", "rest", "rest-noise"};
    for (std::size_t i = 0; i < 4; ++i) {
        const auto& one = result.at("cases").at(i);
        EXPECT_EQ(one.at("name"), names[i]);
        EXPECT_GT(one.at("frame").at("median_ms").get<double>(), 0);
        EXPECT_GE(one.at("frame").at("p99_ms"), one.at("frame").at("median_ms"));
        EXPECT_FALSE(one.at("stages").empty());
        EXPECT_EQ(one.at("tile_share").size(), 4U);
    }
    ASSERT_EQ(result.at("peers").size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        const auto& peer = result.at("peers").at(i);
        const auto& of = result.at("cases").at(i / 2);
        EXPECT_EQ(peer.at("name"), i % 2 == 0 ? "paper" : "paper-fast");
        EXPECT_EQ(peer.at("case"), of.at("name"));
        EXPECT_NEAR(peer.at("ratio").get<double>(),
                    of.at("frame").at("median_ms").get<double>() /
                        peer.at("frame").at("median_ms").get<double>(),
                    1e-9);
    }
    for (const char* key : {"flow", "midpoint", "opencv"})
        EXPECT_GT(result.at("triangulation_ns_per_point").at(key).get<double>(), 0) << key;
    for (const char* key : {"objects", "whole", "still", "new_picture", "remap"})
        EXPECT_GT(result.at("warp").at(key).at("median_ms").get<double>(), 0) << key;
    for (const char* key : {"tracing", "waiting"})
        EXPECT_EQ(result.at("objects").at(key).at("median_ms").get<double>() > 0,
                  MFAR_PATH_TRACING != 0)
            << key;
    const auto hasStage = [&](int i, const char* name) {
        const auto& stages = result.at("cases").at(i).at("stages");
        return std::any_of(stages.begin(), stages.end(),
                           [&](const auto& stage) { return stage.at("stage") == name; });
    };
    for (const char* stage : {"plan", "pyramid", "epipolar", "flow", "weigh", "detail"})
        EXPECT_TRUE(hasStage(1, stage)) << stage;
    EXPECT_FALSE(hasStage(0, "epipolar"));
    const std::string engine = result.at("renderer");
    if (engine.find("engine simd") != std::string::npos) {
        EXPECT_FALSE(hasStage(0, "all stages, by the GPU's clock"));
    }
}

std::vector<std::string> fields(const std::string& line) {
    std::vector<std::string> out;
    std::istringstream in(line + ",");
    for (std::string field; std::getline(in, field, ',');)
        out.push_back(field);
    return out;
}

TEST(MfarBench, CurvesHaveAPointForEveryValueOfEveryKnob) {
    const mfar::test::TempFolder folder;
    const auto out = folder / "new" / "curves";
    const std::string command =
        fmt::format("{} --quick --curves '{}' >/dev/null", MFAR_BENCH, out.string());
    ASSERT_EQ(std::system(command.c_str()), 0);
    EXPECT_TRUE(test::isWellFormed(mfar::test::readFile(out / "curves.svg")));
    std::istringstream csv(mfar::test::readFile(out / "curves.csv"));
    std::string line;
    std::getline(csv, line);
    EXPECT_EQ(line, "method,knob,value,default,ms,epe_px,bad1");
    std::map<std::string, int> values, defaults;
    std::map<std::string, double> last;
    while (std::getline(csv, line)) {
        const auto row = fields(line);
        ASSERT_EQ(row.size(), 7U) << line;
        const double ms = std::stod(row[4]), epe = std::stod(row[5]), bad1 = std::stod(row[6]);
        EXPECT_TRUE(ms > 0 && std::isfinite(ms)) << line;
        EXPECT_TRUE(epe >= 0 && std::isfinite(epe)) << line;
        EXPECT_TRUE(bad1 >= 0 && bad1 <= 1) << line;
        const std::string knob = row[0] + "." + row[1];
        ++values[knob];
        if (row[1].empty()) continue;
        if (values[knob] > 1) {
            EXPECT_GT(std::stod(row[2]), last[knob]) << line;
        }
        last[knob] = std::stod(row[2]);
        defaults[knob] += row[3] == "1" ? 1 : 0;
    }
    EXPECT_EQ(values.size(), 7U + 5 + 2);
    EXPECT_EQ(values["DIS medium."], 1);
    for (const auto& [knob, count] : defaults) {
        EXPECT_GE(values[knob], 3) << knob;
        EXPECT_EQ(count, 1) << knob;
    }
}

std::map<std::string, std::map<std::string, int>> paretoKinds(const std::filesystem::path& csv) {
    std::istringstream lines(mfar::test::readFile(csv));
    std::string line;
    std::getline(lines, line);
    std::map<std::string, std::map<std::string, int>> kinds;
    while (std::getline(lines, line)) {
        const auto row = fields(line);
        EXPECT_GE(row.size(), 7U) << line;
        if (row.size() < 7) continue;
        ++kinds[row[0]][row[2]];
        EXPECT_GT(std::stod(row[3]), 0) << line;
        EXPECT_TRUE(std::isfinite(std::stod(row[4]))) << line;
    }
    return kinds;
}

TEST(MfarBench, ParetoOfSlicingAndWarpHasPointsOfMfarAndPeers) {
    if (!MFAR_PATH_TRACING) GTEST_SKIP() << "built without a path tracer";
    const mfar::test::TempFolder folder;
    const auto csv = folder / "pareto.csv";
    const std::string command =
        fmt::format("{} pareto --quick --rounds 1 --stages slicing,warp --csv '{}' >/dev/null",
                    MFAR_BENCH, csv.string());
    ASSERT_EQ(std::system(command.c_str()), 0);
    auto kinds = paretoKinds(csv);
    ASSERT_EQ(kinds.size(), 2U);
    for (auto& [stage, points] : kinds) {
        EXPECT_EQ(points["default"], 1) << stage;
        EXPECT_GE(points["ours"], 3) << stage;
        EXPECT_GE(points["peer"], 2) << stage;
    }
}

TEST(MfarBench, ParetoWritesAQualityTableThatMfardReads) {
    const mfar::test::TempFolder folder;
    const auto csv = folder / "pareto.csv", svg = folder / "pareto.svg",
               table = folder / "levels.toml";
    const std::string command = fmt::format("{} pareto --quick --rounds 1 --stages superres --csv "
                                            "'{}' --svg '{}' --table '{}' >/dev/null",
                                            MFAR_BENCH, csv.string(), svg.string(), table.string());
    ASSERT_EQ(std::system(command.c_str()), 0);
    EXPECT_TRUE(test::isWellFormed(mfar::test::readFile(svg)));
    auto kinds = paretoKinds(csv);
    ASSERT_EQ(kinds.size(), 1U);
    auto& points = kinds["super-resolution"];
    EXPECT_EQ(points["default"], 1);
    EXPECT_GE(points["ours"], 8);
    EXPECT_GE(points["peer"], 3);
    const auto levels = parseQualityLevels(mfar::test::readFile(table), "levels.toml");
    EXPECT_GE(levels.size(), 2U);
}

TEST(MfarBench, SkipMeasuresTheRequestedCasesAndSkips) {
    const mfar::test::TempFolder folder;
    const auto csv = folder / "skip.csv", svg = folder / "skip.svg";
    const std::string command =
        fmt::format("{} skip --quick --cases still --skips unchanged-tiles --frames 2 --csv '{}' "
                    "--svg '{}' >/dev/null",
                    MFAR_BENCH, csv.string(), svg.string());
    ASSERT_EQ(std::system(command.c_str()), 0);
    EXPECT_TRUE(test::isWellFormed(mfar::test::readFile(svg)));
    std::istringstream lines(mfar::test::readFile(csv));
    std::string line;
    std::getline(lines, line);
    std::getline(lines, line);
    const auto row = fields(line);
    ASSERT_GE(row.size(), 6U) << line;
    EXPECT_EQ(row[0] + "," + row[1], "still,unchanged-tiles");
    EXPECT_GT(std::stod(row[2]), 0);
    EXPECT_TRUE(std::isfinite(std::stod(row[5]))) << line;
    EXPECT_FALSE(std::getline(lines, line));
}

TEST(MfarBench, GovernorIsMeasuredWithTheRequestedDeadline) {
    const mfar::test::TempFolder folder;
    const auto out = folder / "governor.txt", svg = folder / "governor.svg";
    const std::string command =
        fmt::format("{} governor --quick --deadlines 5000 --frames 2 --svg '{}' >'{}'", MFAR_BENCH,
                    svg.string(), out.string());
    ASSERT_EQ(std::system(command.c_str()), 0);
    EXPECT_TRUE(test::isWellFormed(mfar::test::readFile(svg)));
    const std::string said = mfar::test::readFile(out);
    EXPECT_NE(said.find("deadline 5000 ms: p95"), std::string::npos) << said;
    for (const char* scene : {"office", "still", "flat", "moving"})
        EXPECT_NE(said.find(scene), std::string::npos) << said;
    EXPECT_NE(said.find("detail"), std::string::npos) << said;
}

TEST(MfarBench, AFailureToWriteTheOutputEndsWithStatus1) {
    const std::string program = MFAR_BENCH;
    EXPECT_EQ(WEXITSTATUS(std::system((program + " --help >/dev/full 2>/dev/null").c_str())), 1);
}

TEST(MfarBench, InvalidArgumentsEndWithStatus2) {
    const std::string program = MFAR_BENCH;
    EXPECT_EQ(WEXITSTATUS(std::system((program + " --recording /absent 2>/dev/null").c_str())), 2);
    EXPECT_EQ(WEXITSTATUS(std::system((program + " --quick --frames 1 2>/dev/null").c_str())), 2);
    EXPECT_EQ(WEXITSTATUS(std::system((program + " --json /absent/x 2>/dev/null").c_str())), 2);
    EXPECT_EQ(WEXITSTATUS(std::system((program + " --mode magic 2>/dev/null").c_str())), 2);
    EXPECT_EQ(WEXITSTATUS(std::system((program + " --data /tmp 2>/dev/null").c_str())), 2);
    EXPECT_EQ(WEXITSTATUS(std::system((program + " skip --cases none 2>/dev/null").c_str())), 2);
    EXPECT_EQ(WEXITSTATUS(std::system((program + " pareto --stages x 2>/dev/null").c_str())), 2);
    for (const char* wrong : {"--deadlines 0", "--deadlines nan", "--frames 1", "--table /absent"})
        EXPECT_EQ(WEXITSTATUS(std::system(
                      fmt::format("{} governor {} 2>/dev/null", program, wrong).c_str())),
                  2)
            << wrong;
    EXPECT_EQ(WEXITSTATUS(std::system(
                  (program + " pareto --stages flow --table /tmp/x 2>/dev/null").c_str())),
              2);
    EXPECT_EQ(WEXITSTATUS(std::system(
                  (program + " --quick --curves /tmp/x --mode blend 2>/dev/null").c_str())),
              2);
    EXPECT_EQ(WEXITSTATUS(
                  std::system((program + " --curves /absent --data /absent 2>/dev/null").c_str())),
              2);
}

}  // namespace
}  // namespace mfar::bench
