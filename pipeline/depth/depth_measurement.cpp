#include "pipeline/depth/depth_measurement.h"

#include "pipeline/flow/cell_field.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

// Standard deviation of a match along its line [px], as measured against truth in smooth parts.
constexpr float kMatchError = 0.3F;
// Neighbours on one slanted surface that land on the same pixel differ by this much [px].
constexpr float kSlope = 1.5F;
// A cell's vector this close to the pixel's is that of the same surface [px].
constexpr double kSameSurface = 0.5;
constexpr float kLeastDepth = 0.05F;
constexpr float kNothing = -1e9F;

}  // namespace

DepthMeasurement::DepthMeasurement(const CameraModel& video, std::shared_ptr<Workers> workers)
    : lens_(video, 0), focal_(static_cast<float>(std::min(video.fx, video.fy))),
      workers_(std::move(workers)) {
    const auto pixels = static_cast<std::size_t>(video.size.width) * video.size.height;
    landing_.resize(pixels);
    nearest_.resize(pixels);
    s_.resize(pixels);
}

// The cells know their middles to a fraction of a pixel, the pixels on which side of an edge they
// lie.
void DepthMeasurement::takeField(const EpipolarSearch& search, std::span<const float> cells,
                                 const PixelRect& where) {
    const int width = lens_.size().width;
    const PixelRect& area = search.area();
    const std::vector<float>& searched = search.inverseDepth();
    const Size count = cellsOf(lens_.size());
    const auto same = static_cast<float>(kSameSurface / search.pixelsPerUnit());
    workers_->forRange(where.y1 - where.y0, 16, [&](int first, int last) {
        for (int y = where.y0 + first; y < where.y0 + last; ++y) {
            const auto row = static_cast<std::size_t>(y) * width;
            const float* pixels =
                searched.data() + static_cast<std::ptrdiff_t>(y - area.y0) * (area.x1 - area.x0);
            if (cells.empty()) {
                std::copy(pixels + where.x0 - area.x0, pixels + where.x1 - area.x0,
                          s_.data() + row + where.x0);
                continue;
            }
            const float v = std::clamp((static_cast<float>(y) - 1.5F) / 4, 0.0F,
                                       static_cast<float>(count.height) - 1);
            const int j = std::min(static_cast<int>(v), std::max(count.height - 2, 0));
            const float* above = cells.data() + static_cast<std::size_t>(j) * count.width;
            const float* below = above + (count.height > 1 ? count.width : 0);
            const float fy = v - static_cast<float>(j);
            for (int x = where.x0; x < where.x1; ++x) {
                const float u = std::clamp((static_cast<float>(x) - 1.5F) / 4, 0.0F,
                                           static_cast<float>(count.width) - 1);
                const int i = std::min(static_cast<int>(u), std::max(count.width - 2, 0));
                const int next = count.width > 1 ? i + 1 : i;
                const float fx = u - static_cast<float>(i);
                const float top = above[i] + fx * (above[next] - above[i]);
                const float low = below[i] + fx * (below[next] - below[i]);
                const float s = top + fy * (low - top);
                const float own = pixels[x - area.x0];
                s_[row + x] = std::abs(s - own) < same ? s : own;
            }
        }
    });
}

void DepthMeasurement::land(const EpipolarSearch& search, const Eigen::Matrix3f& R,
                            const PixelRect& where) {
    const Eigen::Vector3f& t = search.translation();
    const int width = lens_.size().width;
    workers_->forRange(where.y1 - where.y0, 16, [&](int first, int last) {
        for (int y = where.y0 + first; y < where.y0 + last; ++y) {
            for (int x = where.x0; x < where.x1; ++x) {
                const auto i = static_cast<std::size_t>(y) * width + x;
                const float s = s_[i], rx = lens_.rayX(i), ry = lens_.rayY(i);
                const Eigen::Vector3f p = R * Eigen::Vector3f(rx + s * (t.x() - rx * t.z()),
                                                              ry + s * (t.y() - ry * t.z()), 1);
                const float z = std::max(p.z(), kLeastDepth);
                const auto q = lens_.project(p.x() / z, p.y() / z);
                landing_[i] = p.z() > kLeastDepth ? lens_.pixelAt(q) : -1;
            }
        }
    });
    std::fill(nearest_.begin(), nearest_.end(), kNothing);
    for (int y = where.y0; y < where.y1; ++y) {
        for (int x = where.x0; x < where.x1; ++x) {
            const auto i = static_cast<std::size_t>(y) * width + x;
            if (landing_[i] < 0) continue;
            float& nearest = nearest_[static_cast<std::size_t>(landing_[i])];
            nearest = std::max(nearest, s_[i]);
        }
    }
}

void DepthMeasurement::run(const EpipolarSearch& search, const Eigen::Matrix3f& R_other_video,
                           double unit, std::span<const float> cells, const PixelRect& where,
                           InverseDepthField& out) {
    const int width = lens_.size().width;
    const bool parallax = search.pixelsPerUnit() > 0 && unit > 0;
    if (parallax) takeField(search, cells, where);
    if (parallax) land(search, R_other_video, where);
    const Eigen::Vector3f& t = search.translation();
    const auto perUnit = static_cast<float>(parallax ? 1 / unit : 0);
    const auto slack = static_cast<float>(parallax ? kSlope / search.pixelsPerUnit() : 0);
    workers_->forRange(where.y1 - where.y0, 16, [&](int first, int last) {
        for (int y = where.y0 + first; y < where.y0 + last; ++y) {
            for (int x = where.x0; x < where.x1; ++x) {
                const auto i = static_cast<std::size_t>(y) * width + x;
                const float s = s_[i];
                const bool seen = parallax && landing_[i] >= 0 &&
                                  s + slack >= nearest_[static_cast<std::size_t>(landing_[i])];
                const float way = focal_ * std::hypot(t.x() - lens_.rayX(i) * t.z(),
                                                      t.y() - lens_.rayY(i) * t.z());
                // rho = s / (1 - s t.z): both change together, EpipolarLens.
                const float depth = 1 - s * t.z();
                if (!(seen && way > 0 && depth > kLeastDepth)) {
                    out.forget(i);
                    continue;
                }
                const float sigma = kMatchError / way / (depth * depth) * perUnit;
                out.rho[i] = std::max(s / depth * perUnit, 0.0F);
                out.variance[i] = sigma * sigma;
            }
        }
    });
}

}  // namespace mfar
