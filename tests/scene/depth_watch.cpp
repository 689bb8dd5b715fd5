#include "tests/scene/depth_watch.h"

#include "hal/virtual/synthetic_ray.h"
#include "tests/measure/eval/metrics/depth_error.h"
#include "tests/measure/eval/virtual_truth.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mfar::test {
namespace {

constexpr int kStep = 3;  // distance between measured pixels [px]
constexpr double kFar = 1000;

double medianOf(std::vector<double>& values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

cv::Mat DepthWatch::trueDepth(Timestamp time) const {
    const CameraModel& video = board_.rig().video;
    const RigidTransform pose = board_.pose(time).T_world_video;
    const double seconds = secondsBetween(board_.epoch(), time);
    const synthetic::Snapshot solids(board_.world(), seconds);
    cv::Mat out(video.size.height, video.size.width, CV_32F, cv::Scalar(0));
    for (int y = 0; y < out.rows; y += kStep) {
        for (int x = 0; x < out.cols; x += kStep) {
            const Eigen::Vector2d ray = video.unproject({x, y});
            if (!(eval::surfaceDepth(object_, pose, ray) > 0)) continue;
            const auto hit =
                solids.cast({pose.translation, pose.rotation * ray.homogeneous()}, kFar);
            if (hit) out.at<float>(y, x) = static_cast<float>(1 / hit->distance);
        }
    }
    return out;
}

// Returns the ratio (measured / true inverse depth) that the previous frame had for the point that
// pixel (x, y) of the new frame shows. It is read at the measured pixel nearest to the point's
// position in the previous frame. Returns 0 if it is unknown. `inverseDepth`: true inverse depth of
// the point in the new frame. `pose`: pose of the new frame (T_world_video).
double DepthWatch::ratioBefore(int x, int y, double inverseDepth,
                               const RigidTransform& pose) const {
    const CameraModel& video = board_.rig().video;
    const Eigen::Vector3d p =
        pose_->inverse() * (pose * (video.unproject({x, y}).homogeneous() / inverseDepth));
    if (!(p.z() > 0)) return 0;
    const Eigen::Vector2d q = video.project(p.hnormalized()) / kStep;
    const cv::Point at = kStep * cv::Point(cvRound(q.x()), cvRound(q.y()));
    return cv::Rect({0, 0}, ratio_.size()).contains(at) ? ratio_.at<float>(at) : 0;
}

DepthState DepthWatch::look(const Pipeline& pipeline, Timestamp time) {
    const cv::Mat truth = trueDepth(time);
    const RigidTransform pose = board_.pose(time).T_world_video;
    const InverseDepthField& field = pipeline.inverseDepth();
    cv::Mat inverseDepth(truth.size(), CV_32F, cv::Scalar(0)), ratio = inverseDepth.clone();
    std::vector<double> sigmas, changes;
    for (int y = 0; y < truth.rows; y += kStep) {
        for (int x = 0; x < truth.cols; x += kStep) {
            const auto i = static_cast<std::size_t>(y) * truth.cols + x;
            const float wanted = truth.at<float>(y, x);
            if (!(wanted > 0) || !field.isKnown(i) || !(field.inverseDepth[i] > 0)) continue;
            inverseDepth.at<float>(y, x) = field.inverseDepth[i];
            ratio.at<float>(y, x) = field.inverseDepth[i] / wanted;
            sigmas.push_back(std::sqrt(field.variance[i]) / field.inverseDepth[i]);
            const double before = pose_ ? ratioBefore(x, y, wanted, pose) : 0;
            if (before > 0) changes.push_back(std::abs(ratio.at<float>(y, x) - before));
        }
    }
    ratio_ = ratio;
    pose_ = pose;
    const cv::Mat all(truth.size(), CV_8U, cv::Scalar(255));
    const eval::DepthError error = eval::depthError(inverseDepth, truth, 1, all);
    return {error.absrel, error.completeness, medianOf(sigmas), medianOf(changes)};
}

}  // namespace mfar::test
