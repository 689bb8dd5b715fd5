#pragma once

#include "base/image_view.h"
#include "pipeline/engine/params/luma.h"

#include <cstdint>
#include <vector>

namespace mfar {

using params::kLumaMarginWords;
using params::kLumaSmoothing;
using params::LumaLevel;

/// Words after the last level: a row of a patch reads three words from any column on.
inline constexpr int kLumaSpareWords = 2;

/// Width of a box [video px] with the same variance as a pixel plus the smoothing.
[[nodiscard]] double lumaBoxWidening();

/// The levels of a picture of `size`, finest first; each is half of the one before, rounded up.
/// They begin at `words`, which is advanced past them.
[[nodiscard]] std::vector<LumaLevel> lumaLayout(Size size, std::int32_t& words);

}  // namespace mfar
