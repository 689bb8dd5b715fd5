#include "pipeline/epipolar/turned_picture.h"

#include "pipeline/epipolar/epipolar_lens.h"
#include "pipeline/simd/turned_rows.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

static_assert(TurnedPicture::kAlign == simd::kTurnedCell);

// A ray (x, y, 1) is outside the camera's view if its z after the rotation is at most this.
constexpr double kBeside = 0.2;
constexpr int kSidePoints = 16;

// Upper limit of rimOf(), as a multiple of the radius of the picture's corners.
constexpr double kFarthestRay = 4;

double rimOf(const CameraModel& camera) {
    return rimOf(camera, cornerRadius(camera), kFarthestRay);
}

int alignDown(double v) {
    return static_cast<int>(std::floor(v / TurnedPicture::kAlign)) * TurnedPicture::kAlign;
}

simd::Lens lensOf(const CameraModel& camera) {
    const auto f = [](double v) { return static_cast<float>(v); };
    const auto& d = camera.distortion;
    return {f(camera.fx), f(camera.fy), f(camera.cx), f(camera.cy), f(d[0]),
            f(d[1]),      f(d[2]),      f(d[3]),      f(d[4]),      1};
}

}  // namespace

void TurnedPicture::know(const CameraModel& camera, const CameraModel& whole,
                         const CameraModel& source) {
    known_.camera = camera;
    if (!(whole == known_.whole)) {
        known_.whole = whole;
        known_.rim = rimOf(whole);
    }
    if (source == known_.source) return;
    known_.source = source;
    known_.sourceRim = rimOf(source);
    known_.outline.clear();
    const auto include = [&](double u, double v) {
        known_.outline.push_back(
            source.unproject({u * (source.size.width - 1), v * (source.size.height - 1)}));
    };
    for (int i = 0; i <= kSidePoints; ++i) {
        const double a = static_cast<double>(i) / kSidePoints;
        include(a, 0);
        include(a, 1);
        include(0, a);
        include(1, a);
    }
}

/// Returns the bounds of the part of the source's picture that the camera sees, in pixels of the
/// camera. The bounds are clipped to `whole`. They are empty if the camera sees nothing of the
/// picture.
Eigen::AlignedBox2d TurnedPicture::boundsOf(const Eigen::Matrix3d& R_source_camera,
                                            const Eigen::AlignedBox2d& whole) const {
    Eigen::AlignedBox2d bounds;
    bool before = false;
    for (const Eigen::Vector2d& ray : known_.outline) {
        const Eigen::Vector3d turned = R_source_camera.transpose() * ray.homogeneous();
        // A ray that points sideways or backwards has no position in the camera's picture. The
        // bounds then include all of `whole`.
        if (!(turned.z() > kBeside)) {
            bounds.extend(whole);
            continue;
        }
        const Eigen::Vector2d there = turned.hnormalized();
        bounds.extend(known_.camera.project(there * std::min(1.0, known_.rim / there.norm())));
        before = true;
    }
    return before ? bounds.intersection(whole) : Eigen::AlignedBox2d();
}

void TurnedPicture::place(const CameraModel& camera, const CameraModel& whole,
                          const CameraModel& source, const Eigen::Matrix3d& R_source_camera,
                          double beyond) {
    know(camera, whole, source);
    const double reach = beyond * camera.size.width;
    const Eigen::AlignedBox2d extended(
        Eigen::Vector2d(-reach, -reach),
        Eigen::Vector2d(camera.size.width - 1 + reach, camera.size.height - 1 + reach));
    const Eigen::AlignedBox2d bounds = boundsOf(R_source_camera, extended);
    const Eigen::Vector2d &low = bounds.min(), &high = bounds.max();
    size_ = {};
    if (!((high - low).minCoeff() >= 1)) return;
    origin_ = {alignDown(low.x()), alignDown(low.y())};
    size_ = {static_cast<int>(std::ceil(high.x())) - origin_.x + 1,
             static_cast<int>(std::ceil(high.y())) - origin_.y + 1};
    mapGrid(R_source_camera);
}

void TurnedPicture::mapGrid(const Eigen::Matrix3d& R_source_camera) {
    gridWidth_ = size_.width / kAlign + 2;
    const int gridHeight = size_.height / kAlign + 2;
    const int column = origin_.x / kAlign, row = origin_.y / kAlign;
    const RayLattice::Part rays =
        lattice_.part(known_.camera, {column, row, column + gridWidth_, row + gridHeight});
    simd::TurnedLens lens{lensOf(known_.source), {}, static_cast<float>(known_.sourceRim)};
    for (int i = 0; i < 9; ++i)
        lens.turn[i] = static_cast<float>(R_source_camera(i / 3, i % 3));
    const auto width = static_cast<std::size_t>(gridWidth_);
    gridX_.resize(width * gridHeight);
    gridY_.resize(width * gridHeight);
    for (int j = 0; j < gridHeight; ++j) {
        const auto from = static_cast<std::ptrdiff_t>(j) * rays.pitch;
        simd::turnedPoints(lens, rays.x + from, rays.y + from, width, gridX_.data() + j * width,
                           gridY_.data() + j * width);
    }
}

void TurnedPicture::draw(const LumaImage& picture, Workers& workers, LumaImage& out,
                         std::vector<std::uint8_t>& seen) const {
    if (!(out.size == size_)) out.setSize(size_);
    seen.resize(out.pixels.size());
    const auto width = static_cast<std::size_t>(size_.width);
    workers.forRange(size_.height, kAlign, [&](int first, int last) {
        for (int y = first; y < last; ++y) {
            const auto at = static_cast<std::size_t>(y / kAlign) * gridWidth_;
            const float *x = gridX_.data() + at, *v = gridY_.data() + at;
            simd::turnedRow(picture.rows(), {x, v, x + gridWidth_, v + gridWidth_},
                            static_cast<float>(y % kAlign) / kAlign, width, out.row(y),
                            seen.data() + y * width);
        }
    });
}

}  // namespace mfar
