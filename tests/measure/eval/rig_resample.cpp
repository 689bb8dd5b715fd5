#include "tests/measure/eval/rig_resample.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace mfar::eval {

Size outputSize(const StereoRig& rig) {
    const double aspect = static_cast<double>(rig.video.size.height) / rig.video.size.width;
    return {rig.still.size.width, static_cast<int>(std::lround(rig.still.size.width * aspect))};
}

cv::Mat stillMap(const StereoRig& rig, Size size) {
    const CameraModel view = rig.video.scaledTo(size);
    const Eigen::Matrix3d rotation = rig.T_still_video.rotation.toRotationMatrix();
    cv::Mat map(size.height, size.width, CV_32FC2);
    cv::parallel_for_({0, size.height}, [&](const cv::Range& rows) {
        for (int y = rows.start; y < rows.end; ++y)
            for (int x = 0; x < size.width; ++x) {
                const Eigen::Vector2d ray = view.unproject({x, y});
                const Eigen::Vector3d seen = rotation * Eigen::Vector3d(ray.x(), ray.y(), 1);
                auto& out = map.at<cv::Vec2f>(y, x);
                if (!(seen.z() > 1e-6)) {
                    out = {-1e6F, -1e6F};
                    continue;
                }
                const Eigen::Vector2d p = rig.still.project(seen.head<2>() / seen.z());
                out = {static_cast<float>(p.x()), static_cast<float>(p.y())};
            }
    });
    return map;
}

cv::Mat resampleStill(const cv::Mat& still, const StereoRig& rig) {
    // `dense` has several bilinear samples of the still per video pixel. A video pixel is their
    // mean.
    const double ratio = std::max(rig.still.fx / rig.video.fx, rig.still.fy / rig.video.fy);
    const int samples = std::max(1, static_cast<int>(std::ceil(ratio - 1e-6)));
    const Size fine{rig.video.size.width * samples, rig.video.size.height * samples};
    cv::Mat dense, out;
    cv::remap(still, dense, stillMap(rig, fine), {}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    cv::resize(dense, out, {rig.video.size.width, rig.video.size.height}, 0, 0, cv::INTER_AREA);
    return out;
}

cv::Mat stillShift(const cv::Mat& videoMap, const cv::Mat& flow) {
    cv::Mat lookup(flow.size(), CV_32FC2), moved;
    for (int y = 0; y < flow.rows; ++y)
        for (int x = 0; x < flow.cols; ++x)
            lookup.at<cv::Vec2f>(y, x) =
                flow.at<cv::Vec2f>(y, x) + cv::Vec2f(static_cast<float>(x), static_cast<float>(y));
    cv::remap(videoMap, moved, lookup, {}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    return moved - videoMap;
}

}  // namespace mfar::eval
