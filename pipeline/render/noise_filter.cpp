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

template <class Use>
void NoiseFilter::forNeighbours(std::span<const NoisyPixel> pixels, int x, int y, int reach,
                                int step, Use use) const {
    const NoisyPixel& centre = pixels[static_cast<std::size_t>(y) * size_.width + x];
    for (int dy = -reach; dy <= reach; ++dy) {
        const int v = y + dy * step;
        if (v < 0 || v >= size_.height) continue;
        for (int dx = -reach; dx <= reach; ++dx) {
            const int u = x + dx * step;
            if (u < 0 || u >= size_.width) continue;
            const NoisyPixel& there = pixels[static_cast<std::size_t>(v) * size_.width + u];
            if (there.id != centre.id) continue;
            const auto away = static_cast<float>(step * std::max(std::abs(dx), std::abs(dy)));
            if (std::abs(there.depth - centre.depth) <= kDepthSlope * away * centre.depth)
                use(there, dx, dy);
        }
    }
}

// What is not known is what the neighbours differ by; then the mean of the neighbours', as
// estimates from few samples vary much.
void NoiseFilter::estimateVariances(std::span<NoisyPixel> pixels) const {
    std::vector<float> known(pixels.size());
    for (int y = 0; y < size_.height; ++y)
        for (int x = 0; x < size_.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * size_.width + x;
            known[i] = pixels[i].variance;
            if (pixels[i].id == 0 || known[i] >= 0) continue;
            Eigen::Array4f sum = Eigen::Array4f::Zero(), squares = Eigen::Array4f::Zero();
            float count = 0;
            forNeighbours(pixels, x, y, kSpreadReach, 1, [&](const NoisyPixel& p, int, int) {
                sum += p.value;
                squares += p.value.square();
                ++count;
            });
            const Eigen::Array4f mean = sum / count;
            known[i] = std::max(0.0F, (squares / count - mean.square()).mean());
        }
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i].variance = known[i];
    for (int y = 0; y < size_.height; ++y)
        for (int x = 0; x < size_.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * size_.width + x;
            if (pixels[i].id == 0) continue;
            float sum = 0, count = 0;
            forNeighbours(pixels, x, y, 1, 1, [&](const NoisyPixel& p, int, int) {
                sum += p.variance;
                ++count;
            });
            known[i] = sum / count;
        }
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i].variance = known[i];
}

void NoiseFilter::pass(int step, std::span<const NoisyPixel> from, std::span<NoisyPixel> to) const {
    for (int y = 0; y < size_.height; ++y)
        for (int x = 0; x < size_.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * size_.width + x;
            const NoisyPixel& centre = from[i];
            to[i] = centre;
            if (centre.id == 0 || centre.kept) continue;
            Eigen::Array4f sum = Eigen::Array4f::Zero();
            float weights = 0, variance = 0;
            forNeighbours(from, x, y, kReach, step, [&](const NoisyPixel& p, int dx, int dy) {
                const float noise = centre.variance + p.variance + kLeastVariance;
                const float likeness =
                    1 - squaredDifference(centre, p) / (kTolerance * kTolerance * noise) -
                    squaredPaintDifference(centre, p) / (kPaintTolerance * kPaintTolerance * noise);
                if (!(likeness > 0)) return;
                const float weight =
                    kSpline[std::abs(dx)] * kSpline[std::abs(dy)] * likeness * likeness;
                sum += weight * p.value;
                variance += weight * weight * p.variance;
                weights += weight;
            });
            to[i].value = sum / weights;
            to[i].variance = variance / (weights * weights);
        }
}

void NoiseFilter::operator()(Size size, std::vector<NoisyPixel>& pixels) {
    size_ = size;
    estimateVariances(pixels);
    other_.resize(pixels.size());
    for (const int step : kSteps) {
        pass(step, pixels, other_);
        pixels.swap(other_);
    }
}

}  // namespace mfar
