#include "tests/measure/bench/xml_check.h"
#include "tests/unit/run_program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace mfar::eval {
namespace {

using test::execute;
using test::Outcome;
using test::TempFolder;

std::map<std::string, std::vector<std::string>> rowsOf(const std::string& csv) {
    std::map<std::string, std::vector<std::string>> out;
    std::istringstream in(csv);
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        std::vector<std::string> fields;
        std::istringstream row(line + ",");
        for (std::string field; std::getline(row, field, ',');)
            fields.push_back(field);
        if (fields.size() > 2) out[fields[2] + " " + fields[1]] = fields;
    }
    return out;
}

TEST(MfarEvalSlicing, MeasuresAndPlotsEachSlicingMethod) {
    const TempFolder folder;
    const std::string dir = folder.path().string();
    const Outcome outcome = execute(
        folder, fmt::format("'{}' slicing --width 48 --height 36 --samples 16 --truth-samples 64 "
                            "--frames 5 --csv '{}/out.csv' --svg '{}/out.svg'",
                            MFAR_EVAL, dir, dir));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const std::string csv = test::readFile(folder / "out.csv");
    EXPECT_TRUE(
        csv.starts_with("recording,frame,method,ms,rmse,rmse_filtered,frame_cv,frame_p95,frame_max,"
                        "budget_mean,budget_p95_off\n"))
        << csv;
    const auto rows = rowsOf(csv);
    const auto error = [&](const std::string& row) {
        return rows.contains(row) ? std::stod(rows.at(row)[4]) : std::nan("");
    };
    for (const char* way : {"time", "spatial", "full"})
        EXPECT_EQ(error(fmt::format("{} 16", way)), error("time 16")) << "the same samples\n"
                                                                      << csv;
    EXPECT_GT(error("time 1"), error("time 16"));
    EXPECT_LT(std::stod(rows.at("time 4")[5]), 0.95 * error("time 4")) << "after smoothing";
    EXPECT_EQ(error("time 1"), error("full 1"));
    EXPECT_GT(error("spatial 1"), error("time 1")) << "most tiles are still empty";
    for (const char* row :
         {"time frames", "spatial frames", "time budget", "spatial budget", "time-adaptive 1"})
        EXPECT_TRUE(rows.contains(row)) << row << '\n' << csv;
    const std::string svg = test::readFile(folder / "out.svg");
    EXPECT_TRUE(bench::test::isWellFormed(svg));
    EXPECT_NE(svg.find("spatial-adaptive"), std::string::npos);
}

TEST(MfarEvalSlicing, InvalidRequestsEndWithAMessageAndStatus2) {
    const TempFolder folder;
    for (const char* arguments :
         {"--samples 0", "--budget nan", "--threads 0", "--width 0", "--frames 301"}) {
        const Outcome outcome =
            execute(folder, fmt::format("'{}' slicing {}", MFAR_EVAL, arguments));
        EXPECT_EQ(outcome.status, 2) << arguments;
        const std::string_view words(arguments), option = words.substr(0, words.find(' '));
        EXPECT_NE(outcome.text.find(option), std::string::npos) << outcome.text;
    }
    const Outcome outcome =
        execute(folder, fmt::format("'{}' slicing --width 16 --height 16 --samples 1 "
                                    "--truth-samples 1 --frames 1 --svg '{}/absent/out.svg'",
                                    MFAR_EVAL, folder.path().string()));
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.text.find("cannot be written"), std::string::npos) << outcome.text;
}

}  // namespace
}  // namespace mfar::eval
