#include "pipeline/epipolar/epipolar_lens.h"

namespace mfar {
namespace {

// Upper limit of rimOf(), as a multiple of the radius of the picture's corners.
constexpr double kBeyondPicture = 2;

}  // namespace

double cornerRadius(const CameraModel& camera) {
    double radius = 0;
    for (const double x : {0.0, camera.size.width - 1.0})
        for (const double y : {0.0, camera.size.height - 1.0})
            radius = std::max(radius, camera.unproject({x, y}).norm());
    return radius;
}

double rimOf(const CameraModel& camera, double picture, double beyond) {
    const auto& k = camera.distortion;
    const auto distorted = [&](double r) {
        const double q = r * r;
        return r * (1 + q * (k[0] + q * (k[1] + q * k[4])));
    };
    constexpr int kSteps = 64;
    double rim = picture;
    for (int i = 1; i <= kSteps; ++i) {
        const double r = picture * (1 + (beyond - 1) * i / kSteps);
        if (!(distorted(r) > distorted(rim))) break;
        rim = r;
    }
    return rim;
}

EpipolarLens::EpipolarLens(const CameraModel& camera, int level)
    : size_(camera.size), rays_(std::make_shared<Rays>()) {
    const double scale = 1.0 / (1 << level);
    for (int i = 0; i < level; ++i)
        size_ = {(size_.width + 1) / 2, (size_.height + 1) / 2};
    const auto& d = camera.distortion;
    lens_.fx = static_cast<float>(camera.fx * scale);
    lens_.fy = static_cast<float>(camera.fy * scale);
    lens_.cx = static_cast<float>((camera.cx + 0.5) * scale - 0.5);
    lens_.cy = static_cast<float>((camera.cy + 0.5) * scale - 0.5);
    lens_.k1 = static_cast<float>(d[0]);
    lens_.k2 = static_cast<float>(d[1]);
    lens_.p1 = static_cast<float>(d[2]);
    lens_.p2 = static_cast<float>(d[3]);
    lens_.k3 = static_cast<float>(d[4]);
    const auto pixels = static_cast<std::size_t>(size_.width) * size_.height;
    rays_->x.reserve(pixels);
    rays_->y.reserve(pixels);
    double rim = 0;
    Eigen::Vector2d ray(0, 0);
    for (int y = 0; y < size_.height; ++y) {
        for (int x = 0; x < size_.width; ++x) {
            const Eigen::Vector2d fine((x + 0.5) / scale - 0.5, (y + 0.5) / scale - 0.5);
            ray = camera.unproject(fine, ray);
            rays_->x.push_back(static_cast<float>(ray.x()));
            rays_->y.push_back(static_cast<float>(ray.y()));
            rim = std::max(rim, ray.squaredNorm());
        }
    }
    // The lower limit 1e-12 is for a picture of one pixel. Its only ray may be the optical axis.
    lens_.rim2 = std::max(
        static_cast<float>(std::pow(rimOf(camera, std::sqrt(rim), kBeyondPicture), 2)), 1e-12F);
}

void EpipolarLens::cover(const EpipolarLens& whole, const PixelRect& pixels) {
    size_ = {pixels.x1 - pixels.x0, pixels.y1 - pixels.y0};
    lens_ = whole.lens_;
    lens_.cx -= static_cast<float>(pixels.x0);
    lens_.cy -= static_cast<float>(pixels.y0);
    if (size_ == whole.size_) {
        rays_ = whole.rays_;
        return;
    }
    // If other lenses share the rays, this lens needs new memory. Otherwise, the memory is used
    // again.
    if (rays_.use_count() > 1) rays_ = std::make_shared<Rays>();
    const auto take = [&](const std::vector<float>& from, std::vector<float>& to) {
        to.clear();
        for (int y = pixels.y0; y < pixels.y1; ++y) {
            const auto row = from.begin() + static_cast<long>(y) * whole.size_.width;
            to.insert(to.end(), row + pixels.x0, row + pixels.x1);
        }
    };
    take(whole.rays_->x, rays_->x);
    take(whole.rays_->y, rays_->y);
}

}  // namespace mfar
