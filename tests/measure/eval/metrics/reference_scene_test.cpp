#include "tests/measure/eval/metrics/hdrvdp.h"
#include "tests/measure/eval/metrics/lpc_si.h"
#include "tests/measure/eval/metrics/reference_data.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace mfar::eval {
namespace {

using namespace test;

double differenceFrom(const std::string& name, const cv::Mat& picture) {
    return cv::norm(referencePicture(name), cv::Mat_<double>(picture), cv::NORM_INF);
}

// The FullSize tests compute their input with referenceScene(), so its result must equal the stored
// reference pictures.
TEST(ReferenceScene, SceneMatchesTheReferencePictures) {
    if (referenceTable("lpc_si.csv").empty())
        GTEST_SKIP() << referenceFolder().string() << " is not there";
    const cv::Mat scene = referenceScene(1);
    EXPECT_EQ(differenceFrom("base", scene), 0);
    EXPECT_EQ(differenceFrom("bilin3p6", bilinearFromLow(scene)), 0);
    EXPECT_EQ(differenceFrom("blur2", blurred(scene, 2)), 0);
}

TEST(FullSize, QualityAndSharpnessMatchTheReferenceTable) {
    const auto table = referenceTable("fullsize_2304x1728.csv");
    if (table.empty()) GTEST_SKIP() << referenceFolder().string() << " is not there";
    const cv::Mat scene = referenceScene(8);
    const std::map<std::string, cv::Mat> pictures{
        {"base", cv::Mat_<double>(scene)},
        {"bilin3p6", cv::Mat_<double>(bilinearFromLow(scene))},
        {"blur2", cv::Mat_<double>(blurred(scene, 2))}};
    const auto light = [&](const std::string& name) {
        return displayedLight(pictures.at(name), {});
    };
    int checked = 0;
    for (const auto& row : table) {
        const std::string &metric = row.text("metric"), &test = row.text("test");
        if (metric.starts_with("sha256")) continue;
        const double got = metric == "lpc_si_v1"
                               ? lpcSi(pictures.at(test))
                               : hdrVdp(light(test), light(row.text("reference")), 30).q;
        EXPECT_NEAR(got, row.number("value"), 1e-6 * row.number("value")) << metric << ' ' << test;
        ++checked;
    }
    EXPECT_EQ(checked, 5);
}

}  // namespace
}  // namespace mfar::eval
