#include "pipeline/render/share_table.h"

#include <algorithm>
#include <numeric>

namespace mfar {

ShareTable::ShareTable(std::span<const double> weights) {
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (!(sum > 0)) return;
    double before = 0;
    for (const double weight : weights) {
        before += weight;
        ends_.push_back(before / sum);
    }
}

ShareTable::Drawn ShareTable::draw(double u) const {
    // The last end is exactly 1, so any `u` below 1 finds an end above it. The limit only guards
    // against larger values of `u`.
    const auto end = std::min(std::ranges::upper_bound(ends_, u), ends_.end() - 1);
    const double low = end == ends_.begin() ? 0 : *(end - 1);
    return {static_cast<std::uint32_t>(end - ends_.begin()),
            std::clamp(static_cast<float>((u - low) / (*end - low)), 0.0F, 1 - 0x1p-24F)};
}

}  // namespace mfar
