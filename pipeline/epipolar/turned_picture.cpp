#include "pipeline/epipolar/turned_picture.h"

#include "pipeline/epipolar/epipolar_lens.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

constexpr float kOutside = -1e6F;
// Rays flatter than this [z of a picture's ray (x, y, 1)] count as beside the camera.
constexpr double kBeside = 0.2;
// Points along each side of the picture whose hull bounds what is seen of it.
constexpr int kSidePoints = 16;

// Rays are followed to this many times the radius of the picture's corners, if the lens's model
// does not fold them back before.
constexpr double kFarthestRay = 4;

double rimOf(const CameraModel& camera) {
    return rimOf(camera, cornerRadius(camera), kFarthestRay);
}

int alignDown(double v) {
    return static_cast<int>(std::floor(v / TurnedPicture::kAlign)) * TurnedPicture::kAlign;
}

/// Bounds of what the camera sees of the picture, within `whole`; empty: nothing.
Eigen::AlignedBox2d boundsOf(const CameraModel& camera, const CameraModel& source,
                             const Eigen::Matrix3d& R_source_camera,
                             const Eigen::AlignedBox2d& whole) {
    const double rim = rimOf(camera);
    Eigen::AlignedBox2d bounds;
    bool before = false;
    const auto include = [&](double u, double v) {
        const Eigen::Vector2d ray =
            source.unproject({u * (source.size.width - 1), v * (source.size.height - 1)});
        const Eigen::Vector3d turned = R_source_camera.transpose() * ray.homogeneous();
        // Beside or behind the camera: whatever the canvas can hold may be seen.
        if (!(turned.z() > kBeside)) {
            bounds.extend(whole);
            return;
        }
        const Eigen::Vector2d there = turned.hnormalized();
        bounds.extend(camera.project(there * std::min(1.0, rim / there.norm())));
        before = true;
    };
    for (int i = 0; i <= kSidePoints; ++i) {
        const double a = static_cast<double>(i) / kSidePoints;
        include(a, 0);
        include(a, 1);
        include(0, a);
        include(1, a);
    }
    // The picture's rays all lie between those of its outline.
    return before ? bounds.intersection(whole) : Eigen::AlignedBox2d();
}

}  // namespace

void TurnedPicture::place(const CameraModel& camera, const CameraModel& source,
                          const Eigen::Matrix3d& R_source_camera, double beyond) {
    const double reach = beyond * camera.size.width;
    const Eigen::AlignedBox2d whole(
        Eigen::Vector2d(-reach, -reach),
        Eigen::Vector2d(camera.size.width - 1 + reach, camera.size.height - 1 + reach));
    const Eigen::AlignedBox2d bounds = boundsOf(camera, source, R_source_camera, whole);
    const Eigen::Vector2d &low = bounds.min(), &high = bounds.max();
    size_ = {};
    if (!((high - low).minCoeff() >= 1)) return;
    origin_ = {alignDown(low.x()), alignDown(low.y())};
    size_ = {static_cast<int>(std::ceil(high.x())) - origin_.x + 1,
             static_cast<int>(std::ceil(high.y())) - origin_.y + 1};
    mapGrid(camera, source, R_source_camera);
}

void TurnedPicture::mapGrid(const CameraModel& camera, const CameraModel& source,
                            const Eigen::Matrix3d& R_source_camera) {
    const double rim = rimOf(source);
    gridWidth_ = size_.width / kAlign + 2;
    const int gridHeight = size_.height / kAlign + 2;
    grid_.clear();
    for (int j = 0; j < gridHeight; ++j) {
        for (int i = 0; i < gridWidth_; ++i) {
            const Eigen::Vector2d pixel(origin_.x + kAlign * i, origin_.y + kAlign * j);
            const Eigen::Vector2d ray = camera.unproject(pixel);
            const Eigen::Vector3d p = R_source_camera * ray.homogeneous();
            // Beyond its fold the lens shows nothing, and no picture has anything to show.
            const bool shown = (camera.project(ray) - pixel).squaredNorm() < 1e-2;
            Source s{kOutside, kOutside};
            if (shown && p.z() > 0.05 && p.head<2>().norm() < rim * p.z()) {
                const Eigen::Vector2d q = source.project(p.hnormalized());
                s = {static_cast<float>(q.x()), static_cast<float>(q.y())};
            }
            grid_.push_back(s);
        }
    }
}

void TurnedPicture::draw(const LumaImage& picture, Workers& workers, LumaImage& out,
                         std::vector<std::uint8_t>& seen) const {
    if (!(out.size == size_)) out = LumaImage(size_);
    seen.resize(out.pixels.size());
    const float right = static_cast<float>(picture.size.width) - 1.001F;
    const float bottom = static_cast<float>(picture.size.height) - 1.001F;
    workers.forRange(size_.height, kAlign, [&](int first, int last) {
        for (int y = first; y < last; ++y) {
            const float v = static_cast<float>(y % kAlign) / kAlign;
            const Source* above =
                grid_.data() + static_cast<std::ptrdiff_t>(y / kAlign) * gridWidth_;
            const Source* below = above + gridWidth_;
            std::uint8_t* to = out.row(y);
            std::uint8_t* known = seen.data() + static_cast<std::size_t>(y) * size_.width;
            for (int x = 0; x < size_.width; ++x) {
                const int c = x / kAlign;
                const float u = static_cast<float>(x % kAlign) / kAlign;
                const float ax = above[c].x + v * (below[c].x - above[c].x);
                const float ay = above[c].y + v * (below[c].y - above[c].y);
                const float bx = above[c + 1].x + v * (below[c + 1].x - above[c + 1].x);
                const float by = above[c + 1].y + v * (below[c + 1].y - above[c + 1].y);
                const float sx = ax + u * (bx - ax), sy = ay + u * (by - ay);
                known[x] = sx > -0.5F && sy > -0.5F && sx < right + 0.5F && sy < bottom + 0.5F;
                const float px = std::clamp(sx, 0.0F, right), py = std::clamp(sy, 0.0F, bottom);
                const int ix = static_cast<int>(px), iy = static_cast<int>(py);
                const float fx = px - static_cast<float>(ix), fy = py - static_cast<float>(iy);
                const std::uint8_t* p = picture.row(iy) + ix;
                const std::uint8_t* q = p + picture.size.width;
                const float top = static_cast<float>(p[0]) + fx * static_cast<float>(p[1] - p[0]);
                const float low = static_cast<float>(q[0]) + fx * static_cast<float>(q[1] - q[0]);
                const float rounded = top + fy * (low - top) + 0.5F;
                to[x] = static_cast<std::uint8_t>(rounded);
            }
        }
    });
}

}  // namespace mfar
