#include "pipeline/render/lens_rays.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

constexpr int kCell = 4;  // distance between nodes of the table [px]
constexpr int kOutside = 1;
constexpr int kLongestSide = 16384;

int nodesFor(int pixels) {
    return (pixels - 1 + 2 * kOutside + kCell - 1) / kCell + 1;
}

}  // namespace

LensRays::LensRays(const CameraModel& camera)
    : camera_(camera), columns_(nodesFor(camera.size.width)), rows_(nodesFor(camera.size.height)) {
    nodes_.reserve(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    for (int row = 0; row < rows_; ++row)
        for (int column = 0; column < columns_; ++column)
            nodes_.emplace_back(
                camera.unproject({column * kCell - kOutside, row * kCell - kOutside})
                    .cast<float>());
}

Eigen::Vector2f LensRays::at(float x, float y) const {
    const float u = std::max(0.0F, (x + kOutside) * (1.0F / kCell));
    const float v = std::max(0.0F, (y + kOutside) * (1.0F / kCell));
    const int column = std::min(static_cast<int>(u), columns_ - 2);
    const int row = std::min(static_cast<int>(v), rows_ - 2);
    const float a = u - static_cast<float>(column), b = v - static_cast<float>(row);
    const Eigen::Vector2f &p = node(column, row), &q = node(column + 1, row);
    const Eigen::Vector2f &r = node(column, row + 1), &s = node(column + 1, row + 1);
    const Eigen::Vector2f top = p + a * (q - p), bottom = r + a * (s - r);
    return top + b * (bottom - top);
}

PixelRect LensRays::pixelsIn(const Eigen::Vector2f& least, const Eigen::Vector2f& most) const {
    PixelRect out;
    for (int row = 0; row + 1 < rows_; ++row)
        for (int column = 0; column + 1 < columns_; ++column) {
            const Eigen::Vector2f &p = node(column, row), &q = node(column + 1, row);
            const Eigen::Vector2f &r = node(column, row + 1), &s = node(column + 1, row + 1);
            const Eigen::Vector2f low = p.cwiseMin(q).cwiseMin(r).cwiseMin(s);
            const Eigen::Vector2f high = p.cwiseMax(q).cwiseMax(r).cwiseMax(s);
            if ((low.array() > most.array()).any() || (high.array() < least.array()).any())
                continue;
            const int x = column * kCell - kOutside, y = row * kCell - kOutside;
            out = around(out, {x, y, x + kCell + 1, y + kCell + 1});
        }
    return common(out, {0, 0, camera_.size.width, camera_.size.height});
}

bool isSound(const CameraModel& camera) {
    const auto side = [](int pixels) { return pixels >= 1 && pixels <= kLongestSide; };
    const auto focal = [](double f) { return std::isfinite(f) && f > 0; };
    return side(camera.size.width) && side(camera.size.height) && focal(camera.fx) &&
           focal(camera.fy) && std::isfinite(camera.cx) && std::isfinite(camera.cy) &&
           std::ranges::all_of(camera.distortion, [](double k) { return std::isfinite(k); });
}

}  // namespace mfar
