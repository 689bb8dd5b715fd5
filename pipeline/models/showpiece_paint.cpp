#include "pipeline/models/showpiece_paint.h"

#include "pipeline/models/value_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mfar {
namespace {

constexpr float kCircle = 2 * std::numbers::pi_v<float>;
constexpr float kBandLow = 0.0872F, kBandHigh = 0.1000F;
constexpr int kScalesAround = 26, kFlutes = 22;

float step(float from, float to, float x) {
    const float t = std::clamp((x - from) / (to - from), 0.0F, 1.0F);
    return t * t * (3 - 2 * t);
}

/// Returns the coverage of a painted line at this distance from its middle. `half` is half of the
/// line's width. The coverage is 1 up to 0.6 `half` and 0 from 1.4 `half` on, and falls smoothly
/// between.
float line(float distance, float half) {
    return 1 - step(0.6F * half, 1.4F * half, std::abs(distance));
}

/// A pattern of overlapping scales with arcs inside (seigaiha). Returns 1 on the line of an arc,
/// and 0 between the lines. A scale has width 1. Rows are 1/4 apart, and each covers the row above.
float scales(float x, float y) {
    constexpr float kRadius = 0.5F, kRow = 0.25F;
    const int lowest = static_cast<int>(std::floor((y - kRadius) / kRow)) + 1;
    for (int row = lowest; static_cast<float>(row) * kRow <= y + kRadius; ++row) {
        const float shift = row % 2 == 0 ? 0.0F : 0.5F;
        const float dx = x - shift - std::round(x - shift), dy = y - static_cast<float>(row) * kRow;
        const float distance = std::hypot(dx, dy);
        if (distance > kRadius) continue;
        return std::max({line(distance - 0.47F, 0.035F), line(distance - 0.31F, 0.028F),
                         line(distance - 0.16F, 0.028F)});
    }
    return 0;
}

float gildingAt(float u, float height) {
    constexpr float kHeightOfScale = 0.0098F;
    const float edges =
        std::max({line(height - kBandLow, 0.00042F), line(height - kBandHigh, 0.00042F),
                  line(height - 0.0864F, 0.00016F), line(height - 0.1009F, 0.00016F),
                  line(height - 0.0262F, 0.00035F)});
    if (height < kBandLow || height > kBandHigh) return edges;
    return std::max(edges, scales(u * kScalesAround, (height - kBandLow) / kHeightOfScale));
}

}  // namespace

float fluteAt(float angle, float height) {
    constexpr float kTwist = 16;
    const float inside = step(0.029F, 0.045F, height) * (1 - step(0.072F, 0.0845F, height));
    const float wave = std::cos(kFlutes * 0.5F * (angle + kTwist * height));
    return inside * (1 - std::sqrt(wave * wave + 0.03F));
}

PaintedPoint glazeAt(float u, float height) {
    const Eigen::Vector3f deep(0.006F, 0.018F, 0.105F), bright(0.012F, 0.135F, 0.25F),
        gold(0.93F, 0.66F, 0.27F);
    const float angle = u * kCircle;
    const Eigen::Vector3f place(std::cos(angle), std::sin(angle), height * 22);
    const float cloud = fractalNoise(place * 2.2F, 4);
    // Glaze runs down before it sets. It is thick and dark at the foot, at the shoulder and in the
    // grooves.
    const float belly = step(0.03F, 0.058F, height + 0.006F * cloud) *
                        (1 - step(0.066F, 0.086F, height + 0.004F * cloud));
    const float thin =
        std::clamp(belly - 0.8F * std::max(fluteAt(angle, height), 0.0F), 0.0F, 1.0F);
    PaintedPoint out{deep + thin * (bright - deep), 0.07F + 0.03F * std::abs(cloud), 0,
                     3e-5F * cloud};
    const float gilded = gildingAt(u, height);
    out.colour += gilded * (gold - out.colour);
    out.roughness = std::lerp(out.roughness, 0.24F + 0.08F * cloud, gilded);
    out.metallic = gilded > 0.5F ? 1 : 0;
    out.height += 6e-5F * gilded;
    return out;
}

PaintedPoint walnutAt(const Eigen::Vector3f& place) {
    const Eigen::Vector3f light(0.20F, 0.092F, 0.040F), dark(0.050F, 0.020F, 0.0095F);
    constexpr float kRing = 0.0042F;
    const Eigen::Vector3f bent =
        place + 0.0035F * Eigen::Vector3f(0, fractalNoise(place * 38, 3),
                                          fractalNoise(place * 38 + Eigen::Vector3f(7, 3, 1), 3));
    const float ring = std::hypot(bent.y() + 0.021F, bent.z() + 0.034F) / kRing;
    const float season = ring - std::floor(ring);
    const float late = season * season * (1 - step(0.93F, 1, season));
    const float fibre = fractalNoise(place.cwiseProduct(Eigen::Vector3f(120, 1900, 1900)), 2);
    const float pore =
        step(0.42F, 0.75F, valueNoise(place.cwiseProduct(Eigen::Vector3f(260, 2600, 2600))));
    const float shade = std::clamp(0.2F + 0.7F * late + 0.35F * fibre, 0.0F, 1.0F);
    PaintedPoint out{light + shade * (dark - light), 0.36F + 0.12F * shade + 0.2F * pore, 0,
                     -2.5e-5F * pore + 4e-6F * fibre};
    out.colour *= 1 - 0.45F * pore;
    return out;
}

}  // namespace mfar
