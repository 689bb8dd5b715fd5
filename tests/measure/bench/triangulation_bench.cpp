#include "tests/measure/bench/triangulation_bench.h"

#include "tests/measure/bench/summary.h"
#include "tests/measure/eval/stopwatch.h"
#include "tests/measure/triangulation/triangulation.h"

#include <opencv2/calib3d.hpp>

#include <utility>
#include <vector>

namespace mfar::bench {
namespace {

constexpr int kRuns = 9;
constexpr int kPeerPoints = 5000;  // few, because OpenCV's function is slow

struct Views {
    explicit Views(Size size)
        : camera(CameraModel{{640, 480}, 600, 600, 320, 240, {-0.12, 0.03, 0.001, -0.002, 0.01}}
                     .scaledTo(size)),
          T_b_a{Eigen::Quaterniond(Eigen::AngleAxisd(0.03, Eigen::Vector3d(1, 2, 3).normalized())),
                {-0.1, 0.02, 0.01}} {}

    /// Normalised coordinates, in both views, of the scene point that a pixel shows.
    [[nodiscard]] std::pair<Eigen::Vector2d, Eigen::Vector2d> rays(int x, int y) const {
        const double inverseDepth = 0.3 + 0.2 * x / camera.size.width;
        const Eigen::Vector2d a = camera.unproject({x, y});
        const Eigen::Vector3d b =
            T_b_a.rotation * a.homogeneous().eval() + inverseDepth * T_b_a.translation;
        return {a, b.hnormalized()};
    }

    CameraModel camera;
    RigidTransform T_b_a;
};

std::vector<float> flowOf(const Views& views) {
    const Size size = views.camera.size;
    std::vector<float> flow;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const Eigen::Vector2d end = views.camera.project(views.rays(x, y).second);
            flow.push_back(static_cast<float>(end.x() - x));
            flow.push_back(static_cast<float>(end.y() - y));
        }
    return flow;
}

class OpenCv {
public:
    explicit OpenCv(const Views& views)
        : first_(2, kPeerPoints, CV_64F), second_(2, kPeerPoints, CV_64F),
          fromFirst_(cv::Mat::eye(3, 4, CV_64F)), fromSecond_(3, 4, CV_64F) {
        const Size size = views.camera.size;
        for (int i = 0; i < kPeerPoints; ++i) {
            const auto [a, b] = views.rays(7 * i % size.width, 5 * i % size.height);
            for (int k = 0; k < 2; ++k) {
                first_.at<double>(k, i) = a[k];
                second_.at<double>(k, i) = b[k];
            }
        }
        const Eigen::Matrix3d R = views.T_b_a.rotation.toRotationMatrix();
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 4; ++column)
                fromSecond_.at<double>(row, column) =
                    column < 3 ? R(row, column) : views.T_b_a.translation[row];
    }
    void run() { cv::triangulatePoints(fromFirst_, fromSecond_, first_, second_, points_); }

private:
    cv::Mat first_, second_, fromFirst_, fromSecond_, points_;
};

}  // namespace

TriangulationTimes measureTriangulation(Size video) {
    const Views views(video);
    Triangulation stage(views.camera, views.camera);
    OpenCv opencv(views);
    const std::vector<float> flow = flowOf(views);
    const auto ours = [&](TriangulationMethod method) {
        return eval::wallMs([&] { stage.run(flow, views.T_b_a, {.method = method}); });
    };
    std::vector<double> fast, midpoint, peer;
    for (int i = 0; i <= kRuns; ++i) {
        const double a = ours(TriangulationMethod::Flow), b = ours(TriangulationMethod::Midpoint);
        const double c = eval::wallMs([&] { opencv.run(); });
        if (i == 0) continue;
        fast.push_back(a);
        midpoint.push_back(b);
        peer.push_back(c);
    }
    const double nsPerPoint = 1e6 / (1.0 * video.width * video.height);
    return {summarise(fast).median * nsPerPoint, summarise(midpoint).median * nsPerPoint,
            summarise(peer).median * 1e6 / kPeerPoints};
}

}  // namespace mfar::bench
