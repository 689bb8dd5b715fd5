#include "tests/measure/bench/curve_samples.h"
#include "tests/measure/eval/metrics/flow_error.h"
#include "tests/measure/eval/paper_pipeline.h"
#include "tests/measure/eval/rig_resample.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace mfar::bench {
namespace {

cv::Mat grey(const cv::Mat& picture) {
    cv::Mat out;
    cv::cvtColor(picture, out, cv::COLOR_BGR2GRAY);
    return out;
}

TEST(SyntheticCurveSamples, TrueFlowAgreesWithOpenCvsFlow) {
    const auto samples = syntheticCurveSamples({320, 240});
    ASSERT_EQ(samples.size(), 2U);
    for (const CurveSample& sample : samples) {
        EXPECT_TRUE(sample.hasPoses());
        ASSERT_EQ(sample.truth.size(), sample.frame.picture.size());
        cv::Mat flow;
        eval::createDis(eval::DisPreset::Medium)
            ->calc(grey(sample.frame.picture),
                   grey(eval::resampleStill(sample.still.picture, sample.rig)), flow);
        const eval::FlowError found = eval::flowError(flow, sample.truth);
        const eval::FlowError none =
            eval::flowError(cv::Mat::zeros(flow.size(), CV_32FC2), sample.truth);
        EXPECT_GT(found.known, sample.truth.total() / 2) << sample.name;
        EXPECT_LT(found.bad1, 0.2) << sample.name;
        EXPECT_GT(none.epe, 2 * found.epe) << sample.name;
    }
}

}  // namespace
}  // namespace mfar::bench
