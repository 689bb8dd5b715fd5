#include "pipeline/epipolar/ray_lattice.h"

#include <cmath>
#include <limits>

namespace mfar {
namespace {

// On each side, this number of additional points is computed, because the next frame often needs
// them.
constexpr int kRoom = 4;

}  // namespace

RayLattice::Part RayLattice::part(const CameraModel& camera, const PixelRect& points) {
    const int stepsX = static_cast<int>(std::floor(camera.cx / kStep));
    const int stepsY = static_cast<int>(std::floor(camera.cy / kStep));
    CameraModel first = camera;
    first.size = {};
    first.cx -= stepsX * kStep;
    first.cy -= stepsY * kStep;
    if (!(first == camera_)) {
        camera_ = first;
        known_ = {};
    }
    const PixelRect asked{points.x0 - stepsX, points.y0 - stepsY, points.x1 - stepsX,
                          points.y1 - stepsY};
    if (around(known_, asked) != known_)
        cover(around(known_,
                     {asked.x0 - kRoom, asked.y0 - kRoom, asked.x1 + kRoom, asked.y1 + kRoom}));
    const int pitch = known_.x1 - known_.x0;
    const auto at = static_cast<std::size_t>(asked.y0 - known_.y0) * pitch + asked.x0 - known_.x0;
    return {x_.data() + at, y_.data() + at, pitch};
}

void RayLattice::cover(const PixelRect& points) {
    std::vector<float> x, y;
    const auto count = static_cast<std::size_t>(points.area());
    x.reserve(count);
    y.reserve(count);
    const int pitch = known_.x1 - known_.x0;
    for (int j = points.y0; j < points.y1; ++j) {
        for (int i = points.x0; i < points.x1; ++i) {
            if (i >= known_.x0 && i < known_.x1 && j >= known_.y0 && j < known_.y1) {
                const auto k = static_cast<std::size_t>(j - known_.y0) * pitch + i - known_.x0;
                x.push_back(x_[k]);
                y.push_back(y_[k]);
                continue;
            }
            const Eigen::Vector2d pixel(kStep * i, kStep * j);
            const Eigen::Vector2d ray = camera_.unproject(pixel);
            // If the lens model folds rays back beyond a certain radius, no ray belongs to a pixel
            // beyond it.
            const bool shown = (camera_.project(ray) - pixel).squaredNorm() < 1e-2;
            constexpr float kNoRay = std::numeric_limits<float>::quiet_NaN();
            x.push_back(shown ? static_cast<float>(ray.x()) : kNoRay);
            y.push_back(shown ? static_cast<float>(ray.y()) : kNoRay);
        }
    }
    x_.swap(x);
    y_.swap(y);
    known_ = points;
}

}  // namespace mfar
