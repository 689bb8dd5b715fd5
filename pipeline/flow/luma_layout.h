#pragma once

#include "base/image_view.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// One level of a luma pyramid: 8 bits a pixel, four pixels a word, the leftmost in the low byte.
/// Mirrors an ivec4 in the shaders.
struct LumaLevel {
    std::int32_t offset;  ///< of the level in the pyramid's memory [words]
    std::int32_t pitch;   ///< [words], with kLumaMarginWords of replicated border on each side
    std::int32_t width;   ///< [px]
    std::int32_t height;  ///< [px]
};

inline constexpr int kLumaMarginWords = 2;
/// Words behind the last level: a patch row reads three words from any column on.
inline constexpr int kLumaSpareWords = 2;

/// Weight of a neighbour on each side in the smoothing of the finest level. 0.18 gains 0.3 dB on
/// printed text and costs 0.05 dB on photographs against none.
inline constexpr float kLumaSmoothing = 0.18F;
/// A box of this many video pixels has the variance of a pixel and the smoothing together.
[[nodiscard]] double lumaBoxWidening();

/// The levels of a picture of `size`, finest first, each rounded up to half of the one before.
/// They begin at `words`, which is moved behind them.
[[nodiscard]] std::vector<LumaLevel> lumaLayout(Size size, std::int32_t& words);

}  // namespace mfar
