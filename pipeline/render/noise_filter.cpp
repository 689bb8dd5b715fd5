#include "pipeline/render/noise_filter.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mfar {
namespace {

constexpr std::array<int, 3> kSteps = {1, 2, 4};         // between taps [px]
constexpr std::array<float, 2> kSpline = {0.5F, 0.25F};  // B1, half of it
// Of a tap. Two, as in the paper, are twice the work and no better (measured at 1 to 64 samples).
constexpr int kReach = 1;
constexpr int kSpreadReach = 2;  // of the neighbours that tell an unknown variance
// Differences of so many standard errors, of both pixels together, are none of noise.
constexpr float kTolerance = 2.5F;
constexpr float kPaintTolerance = 0.5F;  // the same of what differs by the surface's colour
constexpr float kLeastColour = 0.01F;
constexpr float kLeastVariance = 1e-7F;  // a tenth of a grey level
// Depth changes by no more of itself per pixel on a surface that is not seen edge on.
constexpr float kDepthSlope = 0.01F;

constexpr float kPaintGamma = 2.2F;

float squaredDifference(const NoisyPixel& a, const NoisyPixel& b) {
    return (a.value - b.value).square().mean();
}

// Of what the surfaces' colours make the two differ by.
float squaredPaintDifference(const NoisyPixel& a, const NoisyPixel& b) {
    const Eigen::Array3f share =
        (a.baseColour - b.baseColour) / (0.5F * (a.baseColour + b.baseColour) + kLeastColour);
    return (share * a.value.head<3>() / kPaintGamma).square().mean();
}

}  // namespace

void NoiseFilter::begin(Size size, const PixelRect& where) {
    size_ = size;
    where_ = common(where, {0, 0, size.width, size.height});
    const std::size_t count =
        static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
    pixels_.resize(count);
    other_.resize(count);
    variances_.resize(count);
}

void NoiseFilter::run(int stage, int firstRow, int lastRow) {
    for (int y = std::max(firstRow, where_.y0); y < std::min(lastRow, where_.y1); ++y)
        for (int x = where_.x0; x < where_.x1; ++x)
            switch (stage) {
            case 0: spreadVariance(x, y); break;
            case 1: meanVariance(x, y); break;
            case 3: filter(kSteps[1], other_, pixels_, x, y); break;
            default: filter(kSteps[stage == 2 ? 0 : 2], pixels_, other_, x, y);
            }
}

template <class Use>
void NoiseFilter::forNeighbours(std::span<const NoisyPixel> pixels, int x, int y, int reach,
                                int step, Use use) const {
    const NoisyPixel& centre = pixels[static_cast<std::size_t>(y) * size_.width + x];
    for (int dy = -reach; dy <= reach; ++dy) {
        const int v = y + dy * step;
        if (v < where_.y0 || v >= where_.y1) continue;
        for (int dx = -reach; dx <= reach; ++dx) {
            const int u = x + dx * step;
            if (u < where_.x0 || u >= where_.x1) continue;
            const std::size_t i = static_cast<std::size_t>(v) * size_.width + u;
            const NoisyPixel& there = pixels[i];
            if (there.id != centre.id) continue;
            const auto away = static_cast<float>(step * std::max(std::abs(dx), std::abs(dy)));
            if (std::abs(there.depth - centre.depth) <= kDepthSlope * away * centre.depth)
                use(i, dx, dy);
        }
    }
}

// What is not known is what the neighbours differ by.
void NoiseFilter::spreadVariance(int x, int y) {
    const std::size_t i = static_cast<std::size_t>(y) * size_.width + x;
    variances_[i] = pixels_[i].variance;
    if (pixels_[i].id == 0 || variances_[i] >= 0) return;
    Eigen::Array4f sum = Eigen::Array4f::Zero(), squares = Eigen::Array4f::Zero();
    float count = 0;
    forNeighbours(pixels_, x, y, kSpreadReach, 1, [&](std::size_t j, int, int) {
        sum += pixels_[j].value;
        squares += pixels_[j].value.square();
        ++count;
    });
    const Eigen::Array4f mean = sum / count;
    variances_[i] = std::max(0.0F, (squares / count - mean.square()).mean());
}

// The mean of the neighbours', as estimates from few samples vary much.
void NoiseFilter::meanVariance(int x, int y) {
    NoisyPixel& pixel = pixels_[static_cast<std::size_t>(y) * size_.width + x];
    if (pixel.id == 0) return;
    float sum = 0, count = 0;
    forNeighbours(pixels_, x, y, 1, 1, [&](std::size_t j, int, int) {
        sum += variances_[j];
        ++count;
    });
    pixel.variance = sum / count;
}

void NoiseFilter::filter(int step, std::span<const NoisyPixel> from, std::span<NoisyPixel> to,
                         int x, int y) const {
    const std::size_t i = static_cast<std::size_t>(y) * size_.width + x;
    const NoisyPixel& centre = from[i];
    to[i] = centre;
    if (centre.id == 0 || centre.kept) return;
    Eigen::Array4f sum = Eigen::Array4f::Zero();
    float weights = 0, variance = 0;
    forNeighbours(from, x, y, kReach, step, [&](std::size_t j, int dx, int dy) {
        const NoisyPixel& p = from[j];
        const float noise = centre.variance + p.variance + kLeastVariance;
        const float likeness =
            1 - squaredDifference(centre, p) / (kTolerance * kTolerance * noise) -
            squaredPaintDifference(centre, p) / (kPaintTolerance * kPaintTolerance * noise);
        if (!(likeness > 0)) return;
        const float weight = kSpline[std::abs(dx)] * kSpline[std::abs(dy)] * likeness * likeness;
        sum += weight * p.value;
        variance += weight * weight * p.variance;
        weights += weight;
    });
    to[i].value = sum / weights;
    to[i].variance = variance / (weights * weights);
}

}  // namespace mfar
