#include "tests/measure/eval/metrics/lpc_si.h"
#include "tests/measure/eval/metrics/reference_data.h"

#include <gtest/gtest.h>

#include <map>

namespace mfar::eval {
namespace {

using test::referencePicture;
using test::referenceTable;

/// The tables have eight decimals or ten digits, which limits the tolerance.
void expectNear(double value, double wanted, double relative, const std::string& what) {
    EXPECT_NEAR(value, wanted, std::max(relative * std::abs(wanted), 1e-8)) << what;
}

TEST(LpcSiReference, IndexAndMapOfEveryPictureMatchTheReferenceTable) {
    const auto table = referenceTable("lpc_si.csv");
    if (table.empty()) GTEST_SKIP() << test::referenceFolder().string() << " is not there";
    for (const auto& row : table) {
        const std::string name = row.text("image");
        const cv::Mat picture = referencePicture(name);
        const LpcSharpness got = lpcSharpness(picture);
        expectNear(got.index, row.number("lpc_si_v1"), 1e-6, name);
        expectNear(got.mapMax, row.number("lpc_map_max"), 1e-6, name);
        expectNear(got.mapMean, row.number("lpc_map_mean"), 1e-6, name);
        const LpcSharpness variant = lpcSharpness(picture, kLpcVariant);
        expectNear(variant.index, row.number("lpc_si_sigma033"), 1e-6, name);
        expectNear(variant.mapMax, row.number("lpc_map_max_sigma033"), 1e-6, name);
        expectNear(variant.mapMean, row.number("lpc_map_mean_sigma033"), 1e-6, name);
    }
    EXPECT_EQ(table.size(), 26U);
}

TEST(LpcSiReference, OrientationContributionsMatchTheReferenceTable) {
    const auto table = referenceTable("lpc_si_intermediate.csv");
    if (table.empty()) GTEST_SKIP() << test::referenceFolder().string() << " is not there";
    std::map<std::string, LpcSharpness> results;
    for (const auto& row : table) {
        const std::string name = row.text("image");
        if (!results.contains(name)) results[name] = lpcSharpness(referencePicture(name));
        const int j = static_cast<int>(row.number("orientation"));
        const LpcOrientation& got = results[name].orientations.at(static_cast<std::size_t>(j - 1));
        const std::string what = name + " " + std::to_string(j);
        expectNear(got.filterSum[0], row.number("filter_sum_s1"), 1e-8, what);
        expectNear(got.filterSum[1], row.number("filter_sum_s2"), 1e-8, what);
        expectNear(got.filterSum[2], row.number("filter_sum_s3"), 1e-8, what);
        expectNear(got.mean, row.number("e_mean"), 1e-8, what);
        expectNear(got.deviation, row.number("e_std"), 1e-8, what);
        expectNear(got.threshold, row.number("T"), 1e-8, what);
        expectNear(got.energy, row.number("energy_sum"), 1e-8, what);
        expectNear(got.coarserMean[0], row.number("mean_abs_c2"), 1e-8, what);
        expectNear(got.coarserMean[1], row.number("mean_abs_c3"), 1e-8, what);
    }
}

}  // namespace
}  // namespace mfar::eval
