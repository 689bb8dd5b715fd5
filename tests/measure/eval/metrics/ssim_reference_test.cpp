#include "tests/measure/eval/metrics/psnr.h"
#include "tests/measure/eval/metrics/reference_data.h"
#include "tests/measure/eval/metrics/ssim.h"

#include <gtest/gtest.h>

namespace mfar::eval {
namespace {

/// An independent program computed the table from the published formulas.
TEST(SsimReference, PsnrSsimAndMsSsimMatchTheReferenceTable) {
    const auto table = test::referenceTable("psnr_ssim.csv");
    if (table.empty()) GTEST_SKIP() << test::referenceFolder().string() << " is not there";
    for (const auto& row : table) {
        const std::string what = row.text("test") + ' ' + row.text("ref");
        const cv::Mat picture = test::referencePicture(row.text("test"));
        const cv::Mat truth = test::referencePicture(row.text("ref"));
        EXPECT_NEAR(meanSquaredError(picture, truth), row.number("mse"), 1e-7) << what;
        EXPECT_NEAR(psnr(picture, truth), row.number("psnr_db"), 1e-7) << what;
        EXPECT_NEAR(ssim(picture, truth), row.number("ssim"), 1e-7) << what;
        EXPECT_NEAR(msSsim(picture, truth), row.number("msssim"), 1e-7) << what;
    }
    EXPECT_GT(table.size(), 10U);
}

}  // namespace
}  // namespace mfar::eval
