#include "tests/eval/metrics/luma.h"
#include "tests/eval/metrics/psnr.h"
#include "tests/eval/metrics/ssim.h"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace mfar::eval {
namespace {

/// PSNR and SSIM against values computed by an independent program from the published formulas.
TEST(MetricsReference, PsnrAndSsimAgreeWithTheTable) {
    const std::filesystem::path dir =
        std::filesystem::path(MFAR_SHARED_DATA).parent_path() / "metrics" / "ref";
    std::ifstream table(dir / "psnr_ssim.csv");
    if (!table) GTEST_SKIP() << (dir / "psnr_ssim.csv").string() << " is not there";
    std::string line;
    std::getline(table, line);
    ASSERT_EQ(line.substr(0, 26), "test,ref,mse,psnr_db,ssim,");
    int pairs = 0;
    while (std::getline(table, line)) {
        std::istringstream fields(line);
        std::string name, ref, mse, decibels, similarity;
        std::getline(fields, name, ',');
        std::getline(fields, ref, ',');
        std::getline(fields, mse, ',');
        std::getline(fields, decibels, ',');
        std::getline(fields, similarity, ',');
        const auto load = [&](const std::string& n) {
            return cv::imread((dir / "img" / (n + ".pgm")).string(), cv::IMREAD_UNCHANGED);
        };
        const cv::Mat picture = load(name), truth = load(ref);
        ASSERT_FALSE(picture.empty() || truth.empty()) << line;
        EXPECT_NEAR(meanSquaredError(luma(picture), luma(truth)), std::stod(mse), 1e-7) << line;
        EXPECT_NEAR(psnr(luma(picture), luma(truth)), std::stod(decibels), 1e-7) << line;
        EXPECT_NEAR(ssim(luma(picture), luma(truth)), std::stod(similarity), 1e-7) << line;
        ++pairs;
    }
    EXPECT_GT(pairs, 10);
}

}  // namespace
}  // namespace mfar::eval
