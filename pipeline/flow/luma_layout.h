#pragma once

#include "base/image_view.h"
#include "pipeline/engine/params/luma.h"

#include <cstdint>
#include <vector>

namespace mfar {

using params::kLumaMarginWords;
using params::kLumaSmoothing;
using params::LumaLevel;

/// Number of unused words after the last pyramid level. They are necessary because the shaders
/// always read three words for a row of a patch. The last two of them can lie beyond the end of the
/// last level.
inline constexpr int kLumaSpareWords = 2;

/// Returns the width of a box filter [video px] that blurs as much as two other filters together:
/// the mean over the area of a pixel, and the smoothing by kLumaSmoothing. (The variance of the box
/// is the sum of the variances of these two filters.)
[[nodiscard]] double lumaBoxWidening();

/// Returns the layout of the pyramid levels for a picture of `size`, finest first. Each level has
/// half the size of the level before, rounded up. On entry, `words` is the offset of the first
/// level. On return, it is the offset after the last level.
[[nodiscard]] std::vector<LumaLevel> lumaLayout(Size size, std::int32_t& words);

}  // namespace mfar
