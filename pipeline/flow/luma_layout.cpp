#include "pipeline/flow/luma_layout.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

// Smallest height and width of the third and coarser pyramid levels [px].
constexpr int kShortestSide = 26;
constexpr std::size_t kMaxLevels = 6;
// The second level always exists, because the gain between the sensors is measured there.
constexpr std::size_t kMinLevels = 2;

}  // namespace

// The area of a pixel is a box filter with a variance of 1/12 px^2. The smoothing with three taps
// adds 2 * kLumaSmoothing px^2 to this variance.
double lumaBoxWidening() {
    return std::sqrt(1 + 12 * 2 * kLumaSmoothing);
}

std::vector<LumaLevel> lumaLayout(Size size, std::int32_t& words) {
    std::vector<LumaLevel> levels;
    while (true) {
        const std::int32_t pitch = (size.width + 3) / 4 + 2 * kLumaMarginWords;
        levels.push_back({words, pitch, size.width, size.height});
        words += pitch * size.height;
        size = {(size.width + 1) / 2, (size.height + 1) / 2};
        const bool small = std::min(size.width, size.height) < kShortestSide;
        if (levels.size() >= kMinLevels && (small || levels.size() == kMaxLevels)) return levels;
    }
}

}  // namespace mfar
