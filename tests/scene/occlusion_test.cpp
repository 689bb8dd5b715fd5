// Virtual objects behind real things of the synthetic scenes, against the truth.
#include "hal/gl_context.h"
#include "hal/virtual/synthetic_board.h"
#include "pipeline/pipeline.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <optional>

namespace mfar::test {
namespace {

using namespace std::chrono_literals;

/// On the shelf the windows of the matching reach farther beside thin things than the picture's
/// edges put right.
struct Case {
    synthetic::Scene scene;
    Eigen::Vector3d centre;
    double leastOverlap, mostBoundary;  // [px]
};
constexpr double kRadius = 0.15;  // [m]

/// z of the sphere's surface along a video pixel's ray; 0: it is not there.
double sphereDepth(const Eigen::Vector3d& centre, const Eigen::Vector2d& ray) {
    const Eigen::Vector3d direction = ray.homogeneous();
    const double b = direction.dot(centre), a = direction.squaredNorm();
    const double root = b * b - a * (centre.squaredNorm() - kRadius * kRadius);
    return root > 0 ? (b - std::sqrt(root)) / a : 0;
}

/// Where the object should be seen: CV_8U of the video's size.
cv::Mat trulyShown(const SyntheticBoard& board, const Case& c, Timestamp time) {
    const CameraModel& camera = board.rig().video;
    const FloatImage rho = board.inverseDepth(time);
    const Eigen::Vector3d centre = board.pose(time).T_world_video.inverse() * c.centre;
    cv::Mat out(camera.size.height, camera.size.width, CV_8U, cv::Scalar(0));
    for (int y = 0; y < out.rows; ++y)
        for (int x = 0; x < out.cols; ++x) {
            const double z = sphereDepth(centre, camera.unproject({x, y}));
            const float real = rho.values[static_cast<std::size_t>(y) * out.cols + x];
            if (z > 0 && 1 / z >= real) out.at<std::uint8_t>(y, x) = 255;
        }
    return out;
}

/// The same of the pipeline's picture, at the middle of each video pixel.
cv::Mat shown(const Pipeline& pipeline, Size video) {
    std::vector<float> values = pipeline.readShownObjects();
    const Size size = pipeline.outputSize();
    const cv::Mat whole(size.height, size.width, CV_32F, values.data());
    cv::Mat small;
    cv::resize(whole, small, {video.width, video.height}, 0, 0, cv::INTER_AREA);
    return small >= 0.5;
}

struct Score {
    double overlap;   ///< intersection over union
    double boundary;  ///< mean distance of its boundary from the true one [px]
};

Score scoreOf(const cv::Mat& got, const cv::Mat& truth) {
    const auto boundary = [](const cv::Mat& mask) {
        cv::Mat smaller;
        cv::erode(mask, smaller, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}));
        return cv::Mat(mask - smaller);
    };
    cv::Mat distance;
    cv::distanceTransform(255 - boundary(truth), distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    return {static_cast<double>(cv::countNonZero(got & truth)) / cv::countNonZero(got | truth),
            cv::mean(distance, boundary(got))[0]};
}

std::optional<Frame> taken(Camera& camera) {
    return camera.next(60s);
}

class Occlusion : public testing::TestWithParam<Case> {
protected:
    void SetUp() override { context_->makeCurrent(); }

private:
    std::unique_ptr<GlContext> context_ = createGlContext();
};

TEST_P(Occlusion, RealThingsHideAVirtualOneAtTheirEdges) {
    SyntheticOptions options;
    options.scene = GetParam().scene;
    options.path = synthetic::Path::Handheld;
    options.pace = Pace::Consumer;
    SyntheticBoard board(options);
    board.video().start();
    board.stills().start();
    Pipeline pipeline(board.rig(), {});
    VirtualObject sphere;
    sphere.shape = VirtualShape::Sphere;
    sphere.size.setConstant(2 * kRadius);
    sphere.T_world_object.translation = GetParam().centre;
    pipeline.setObjects({sphere});
    double overlap = 0, boundary = 0;
    int scored = 0;
    for (int frame = 0; frame < 16; ++frame) {
        const auto video = taken(board.video());
        ASSERT_TRUE(video);
        if (frame == 0) board.trigger().fire();
        if (const auto still = board.stills().next(0s))
            pipeline.setStill(still->view(), still->time(), board.pose(still->time()));
        pipeline.run(video->view(), video->time(), board.pose(video->time()));
        if (frame < 8) continue;
        const Score score = scoreOf(shown(pipeline, board.rig().video.size),
                                    trulyShown(board, GetParam(), video->time()));
        overlap += score.overlap;
        boundary += score.boundary;
        ++scored;
    }
    RecordProperty("overlap", std::to_string(overlap / scored));
    RecordProperty("boundary", std::to_string(boundary / scored));
    EXPECT_GT(overlap / scored, GetParam().leastOverlap);
    EXPECT_LT(boundary / scored, GetParam().mostBoundary);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Occlusion,
    testing::Values(Case{synthetic::Scene::Office, {0.02, 0.42, 0.16}, 0.95, 1.5},
                    Case{synthetic::Scene::Shelf, {0.25, 0.35, 0.4}, 0.9, 2.2}),
    [](const auto& c) { return c.param.scene == synthetic::Scene::Office ? "Office" : "Shelf"; });

}  // namespace
}  // namespace mfar::test
