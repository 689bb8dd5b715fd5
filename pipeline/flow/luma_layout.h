#pragma once

#include "base/image_view.h"
#include "pipeline/engine/params/luma.h"

#include <cstdint>
#include <vector>

namespace mfar {

using params::kLumaMarginWords;
using params::kLumaSmoothing;
using params::LumaLevel;

/// Words behind the last level: a patch row reads three words from any column on.
inline constexpr int kLumaSpareWords = 2;

/// A box of this many video pixels has the variance of a pixel and the smoothing together.
[[nodiscard]] double lumaBoxWidening();

/// The levels of a picture of `size`, finest first, each rounded up to half of the one before.
/// They begin at `words`, which is moved behind them.
[[nodiscard]] std::vector<LumaLevel> lumaLayout(Size size, std::int32_t& words);

}  // namespace mfar
