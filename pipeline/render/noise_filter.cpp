#include "pipeline/render/noise_filter.h"

#include "base/large_pages.h"
#include "pipeline/render/rendered_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mfar {
namespace {

constexpr std::array<float, 2> kSpline = {0.5F, 0.25F};
// Radius of the kernel [steps]. The paper's radius of two takes twice the time and is not better
// (measured at 1 to 64 samples).
constexpr int kReach = 1;
// An unknown variance is estimated from neighbours kSpreadStep pixels apart, up to kSpreadReach
// steps away. Sparse sampling covers one pixel in 16, so samples are 4 pixels apart. With fewer
// than kSurely neighbours, the estimate is raised.
constexpr int kSpreadReach = 2, kSpreadStep = 4;
constexpr float kSurely = 4;
// A difference of more than this many standard errors is not noise.
constexpr float kTolerance = 2.5F;
// A sample of the shadow catcher shows either no change or a large one. So with few samples, the
// lit and the shaded pixels of a penumbra would not be averaged, and it would have spots. There the
// levels up to this distance, which is that of sparse samples, tolerate more.
constexpr int kSparseStep = 4;
constexpr float kSparseTolerance = 5;
constexpr float kLeastVariance = 1e-7F;  // (a tenth of a grey level)^2 at white
// Upper limit of the relative change of depth per pixel on one surface.
constexpr float kDepthSlope = 0.01F;

float luminanceOf(const Eigen::Array3f& rgb) {
    return 0.2126F * rgb.x() + 0.7152F * rgb.y() + 0.0722F * rgb.z();
}

/// Returns the eighth power of the cosine between two normals: 1/2 at 24 degrees.
float bendWeight(const Eigen::Array3f& a, const Eigen::Array3f& b) {
    const float cosine = std::max(0.0F, (a * b).sum());
    const float second = cosine * cosine, fourth = second * second;
    return fourth * fourth;
}

class LightMean {
public:
    LightMean(const Eigen::Array3f& centre, float variance, float count, float tolerance)
        : centre_(centre), variance_(variance), tolerance_(tolerance), isKnown_(count > 0) {}

    void add(float weight, const Eigen::Array3f& light, float variance, float count) {
        if (!(count > 0)) return;
        if (isKnown_) {
            const float noise = variance_ + variance + kLeastVariance;
            const float off = luminanceOf(light - centre_);
            const float likeness = 1 - off * off / (tolerance_ * tolerance_ * noise);
            if (!(likeness > 0)) return;
            weight *= likeness * likeness;
        }
        sum_ += weight * light;
        variances_ += weight * weight * variance;
        weights_ += weight;
    }
    void store(Eigen::Array3f& light, float& variance, float& count) const {
        if (!(weights_ > 0)) return;
        light = sum_ / weights_;
        variance = variances_ / (weights_ * weights_);
        count = std::max(count, 1.0F);
    }

private:
    const Eigen::Array3f& centre_;
    float variance_, tolerance_;
    bool isKnown_;
    Eigen::Array3f sum_{0, 0, 0};
    float variances_ = 0, weights_ = 0;
};

struct Spread {
    float sum = 0, squares = 0, count = 0;

    void add(const Eigen::Array3f& light, float samples) {
        if (!(samples > 0)) return;
        const float y = luminanceOf(light);
        sum += y;
        squares += y * y;
        ++count;
    }
    /// Estimates the variance of a pixel's light from the added values. It includes the pixel's own
    /// distance from the mean, because the pixel may hold a rare bright sample. With fewer than
    /// kSurely values, the square of the mean is added.
    [[nodiscard]] float varianceOf(const Eigen::Array3f& light) const {
        if (!(count > 0)) return 0;
        const float mean = sum / count, off = luminanceOf(light) - mean;
        const float spread = std::max(0.0F, squares / count - mean * mean) + off * off;
        return count < kSurely ? spread + mean * mean : spread;
    }
};

}  // namespace

void NoiseFilter::begin(Size size, const PixelRect& where) {
    size_ = size;
    where_ = common(where, {0, 0, size.width, size.height});
    const std::size_t count =
        static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
    const auto resize = [count](auto& pixels) {
        if (pixels.size() == count) return;
        pixels.reserve(count);
        preferLargePages(pixels.data(), count * sizeof(pixels[0]));
        pixels.resize(count);
    };
    resize(pixels_);
    resize(other_);
    resize(variances_);
}

void NoiseFilter::run(int stage, int firstRow, int lastRow) {
    const int level = stage - 2;
    for (int y = std::max(firstRow, where_.y0); y < std::min(lastRow, where_.y1); ++y)
        for (int x = where_.x0; x < where_.x1; ++x) {
            if (stage == 0)
                spreadVariance(x, y);
            else if (stage == 1)
                meanVariance(x, y);
            else if (level % 2 == 0)
                filter(1 << level, pixels_, other_, x, y);
            else
                filter(1 << level, other_, pixels_, x, y);
        }
}

template <class Use>
void NoiseFilter::forNeighbours(std::span<const LightPixel> pixels, int x, int y, int reach,
                                int step, Use use) const {
    const LightPixel& centre = pixels[static_cast<std::size_t>(y) * size_.width + x];
    for (int dy = -reach; dy <= reach; ++dy) {
        const int v = y + dy * step;
        if (v < where_.y0 || v >= where_.y1) continue;
        for (int dx = -reach; dx <= reach; ++dx) {
            const int u = x + dx * step;
            if (u < where_.x0 || u >= where_.x1) continue;
            const std::size_t i = static_cast<std::size_t>(v) * size_.width + u;
            const LightPixel& there = pixels[i];
            if (there.id != centre.id) continue;
            const auto away = static_cast<float>(step * std::max(std::abs(dx), std::abs(dy)));
            if (std::abs(there.depth - centre.depth) <= kDepthSlope * away * centre.depth)
                use(i, dx, dy);
        }
    }
}

void NoiseFilter::spreadVariance(int x, int y) {
    const std::size_t i = static_cast<std::size_t>(y) * size_.width + x;
    const LightPixel& pixel = pixels_[i];
    variances_[i] = {pixel.firstVariance, pixel.secondVariance};
    if (pixel.id == 0 || (pixel.firstVariance >= 0 && pixel.secondVariance >= 0)) return;
    Spread first, second;
    forNeighbours(pixels_, x, y, kSpreadReach, kSpreadStep, [&](std::size_t j, int, int) {
        first.add(pixels_[j].first, pixels_[j].firstCount);
        second.add(pixels_[j].second, pixels_[j].secondCount);
    });
    const auto found = [](const Spread& spread, const Eigen::Array3f& light, float count) {
        return count > 0 ? spread.varianceOf(light) : 0;
    };
    if (pixel.firstVariance < 0) variances_[i].first = found(first, pixel.first, pixel.firstCount);
    if (pixel.secondVariance < 0)
        variances_[i].second = found(second, pixel.second, pixel.secondCount);
}

// Estimates from few samples vary strongly, so neighbours are averaged.
void NoiseFilter::meanVariance(int x, int y) {
    LightPixel& pixel = pixels_[static_cast<std::size_t>(y) * size_.width + x];
    if (pixel.id == 0) return;
    Variances sum;
    float firsts = 0, seconds = 0;
    forNeighbours(pixels_, x, y, 1, 1, [&](std::size_t j, int, int) {
        const bool first = pixels_[j].firstCount > 0, second = pixels_[j].secondCount > 0;
        sum.first += first ? variances_[j].first : 0;
        sum.second += second ? variances_[j].second : 0;
        firsts += first ? 1 : 0;
        seconds += second ? 1 : 0;
    });
    pixel.firstVariance = firsts > 0 ? sum.first / firsts : 0;
    pixel.secondVariance = seconds > 0 ? sum.second / seconds : 0;
}

void NoiseFilter::filter(int step, std::span<const LightPixel> from, std::span<LightPixel> to,
                         int x, int y) const {
    const std::size_t i = static_cast<std::size_t>(y) * size_.width + x;
    const LightPixel& centre = from[i];
    if (centre.id == 0) {
        to[i].id = 0;
        return;
    }
    to[i] = centre;
    if (centre.kept) return;
    const bool isSparse = centre.id == kCatcherId && centre.firstCount < LightPixel::kFew;
    const float tolerance = isSparse && step <= kSparseStep ? kSparseTolerance : kTolerance;
    LightMean first(centre.first, centre.firstVariance, centre.firstCount, tolerance);
    LightMean second(centre.second, centre.secondVariance, centre.secondCount, tolerance);
    forNeighbours(from, x, y, kReach, step, [&](std::size_t j, int dx, int dy) {
        const LightPixel& p = from[j];
        const float weight = kSpline[std::abs(dx)] * kSpline[std::abs(dy)] *
                             (j == i ? 1 : bendWeight(centre.normal, p.normal));
        if (!(weight > 0)) return;
        first.add(weight, p.first, p.firstVariance, p.firstCount);
        second.add(weight, p.second, p.secondVariance, p.secondCount);
    });
    first.store(to[i].first, to[i].firstVariance, to[i].firstCount);
    second.store(to[i].second, to[i].secondVariance, to[i].secondCount);
}

}  // namespace mfar
