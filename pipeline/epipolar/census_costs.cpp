#include "pipeline/epipolar/census_costs.h"

#include "pipeline/epipolar/byte_lanes.h"
#include "pipeline/epipolar/census.h"
#include "pipeline/epipolar/semi_global.h"

#include <bit>
#include <cmath>
#include <cstring>

namespace mfar {
namespace {

constexpr int kUnseenCost = kCensusBits / 2;

std::uint8_t difference(std::uint32_t a, std::uint32_t b) {
    return (b & kNoCensus) != 0 ? kUnseenCost : static_cast<std::uint8_t>(std::popcount(a ^ b));
}

/// Where label k's census goes, so that the counts of four words interleave to bytes in order.
constexpr int slotOf(int label) {
    return label % 4 * 4 + label / 4;
}

/// The same for a whole vector of labels: bits are counted side by side in words, because a count
/// of one word is a slow library call on the oldest processors of both families.
void differences(std::uint32_t own, const std::uint32_t* slots, std::uint8_t* out) {
    using Words = std::uint32_t __attribute__((vector_size(16)));
    Words bytes{};
    for (int i = 3; i >= 0; --i) {
        Words w;
        std::memcpy(&w, slots + 4L * i, sizeof w);
        const Words unseen = Words{} - (w >> 31);
        w ^= own;
        w -= (w >> 1) & 0x55555555U;
        w = (w & 0x33333333U) + ((w >> 2) & 0x33333333U);
        w = (w + (w >> 4)) & 0x0F0F0FU;
        w = (w + (w >> 8) + (w >> 16)) & 0x1FU;
        bytes = (bytes << 8) | (w & ~unseen) | (unseen & kUnseenCost);
    }
    std::memcpy(out, &bytes, sizeof bytes);
}

/// The pixel that holds a coordinate above -0.5.
int pixelOf(float v) {
    const float fromEdge = v + 0.5F;
    return static_cast<int>(fromEdge);
}

}  // namespace

void costsAlong(EpipolarLens::Point from, EpipolarLens::Point to, std::uint32_t own,
                const std::uint32_t* still, Size size, std::uint8_t* out) {
    constexpr int kSteps = SemiGlobal::kLabels - 1;
    constexpr float kOne = 65536.0F;
    const float w = static_cast<float>(size.width) - 0.51F,
                h = static_cast<float>(size.height) - 0.51F;
    const auto inside = [&](EpipolarLens::Point p) {
        return p.x > -0.49F && p.y > -0.49F && p.x < w && p.y < h;
    };
    if (inside(from) && inside(to)) {
        int x = static_cast<int>((from.x + 0.5F) * kOne),
            y = static_cast<int>((from.y + 0.5F) * kOne);
        const int dx = static_cast<int>((to.x - from.x) * (kOne / kSteps));
        const int dy = static_cast<int>((to.y - from.y) * (kOne / kSteps));
        std::uint32_t seen[SemiGlobal::kLabels];
        for (int k = 0; k <= kSteps; ++k, x += dx, y += dy)
            seen[slotOf(k)] = still[(y >> 16) * size.width + (x >> 16)];
        differences(own, seen, out);
        return;
    }
    for (int k = 0; k <= kSteps; ++k) {
        const float a = static_cast<float>(k) / kSteps;
        const EpipolarLens::Point p{from.x + a * (to.x - from.x), from.y + a * (to.y - from.y)};
        out[k] = kUnseenCost;
        if (inside(p)) out[k] = difference(own, still[pixelOf(p.y) * size.width + pixelOf(p.x)]);
    }
}

void takeLesserBeside(EpipolarLens::Point from, EpipolarLens::Point to, std::uint32_t own,
                      const std::uint32_t* still, Size size, std::uint8_t* costs) {
    const float wayX = to.x - from.x, wayY = to.y - from.y, way = std::hypot(wayX, wayY);
    if (!(way > 0)) return;
    for (const float side : {-1 / way, 1 / way}) {
        const float x = -side * wayY, y = side * wayX;
        std::uint8_t beside[SemiGlobal::kLabels];
        costsAlong({from.x + x, from.y + y}, {to.x + x, to.y + y}, own, still, size, beside);
        storeBytes(costs, lesser(loadBytes(costs), loadBytes(beside)));
    }
}

}  // namespace mfar
