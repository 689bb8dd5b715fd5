#include "pipeline/warp/mirror_looks.h"

#include <algorithm>

namespace mfar {
namespace {

constexpr float kLeastAlpha = 1e-3F;

}  // namespace

std::array<MirrorLook, kRoughnesses> mirrorLooks(const MirrorLight& mirrors) {
    const std::vector<MirrorLight::Table>& tables = mirrors.tables;
    std::array<MirrorLook, kRoughnesses> out;
    std::size_t low = 0;
    for (std::size_t i = 0; i < kRoughnesses; ++i) {
        const float roughness = static_cast<float>(i) / (kRoughnesses - 1);
        while (low + 2 < tables.size() && tables[low + 1].roughness < roughness)
            ++low;
        out[i] = {low, 0, std::max({roughness * roughness, mirrors.leastSunAlpha, kLeastAlpha})};
        if (tables.size() < 2) continue;
        // Between the first two tables, the second one's weight grows with the squared roughness,
        // which is the width of the reflection lobe. FarLight::mirrored() does the same.
        const float from = tables[low].roughness, to = tables[low + 1].roughness;
        const float share =
            low == 0 ? roughness * roughness / (to * to) : (roughness - from) / (to - from);
        out[i].share = std::clamp(share, 0.0F, 1.0F);
    }
    return out;
}

}  // namespace mfar
