#pragma once

#include "base/image_view.h"
#include "pipeline/engine/params/detail.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

// Rows of the output, pixels [begin, end). Rows of fields may be read and written up to 64 bytes
// beyond `end`; output rows are written only up to `end`.

/// Look-up positions of a row's pixels: two rows of the look-up field at the output's width, and
/// the position between them. Finite numbers.
struct LookUpRows {
    std::array<const float*, 2> x, y;   ///< [still px], see LookUpCell
    std::array<const float*, 2> share;  ///< weight of the detail, or confidence
    float t;                            ///< 0: the first row, 1: the second
    /// Position without the field's offset: (stepX px + startX, startY) [still px].
    float stepX, startX, startY;
};

/// A still's luma, each pixel with the one below it in the high byte: a 2x2 block is 32 bits. 64
/// readable bytes after each row.
struct StillPairs {
    const std::uint16_t* data;
    std::ptrdiff_t pitch;  ///< pairs from one row to the next
    Size size;
};

/// Samples the still's luma bilinearly at the look-up positions [1/32 grey level].
void warpRow(const StillPairs& still, const LookUpRows& lookUp, int begin, int end,
             std::int16_t* to);

/// Input of guideRow(), in rows of the video's pixels with a margin of kGuideReach on both sides:
/// `differences` between what still and video show, scaled by Guidance, and where the still is
/// trusted.
struct GuideRows {
    static constexpr int kRows = 2 * params::kGuideReach + 1;
    std::array<const float*, kRows> differences;  ///< 0 where not trusted
    std::array<const float*, kRows> trusted;      ///< 1 or 0
};

/// Writes `from`, the still as the video shows it, less the trusted differences from their local
/// mean. All in the same unit.
void guideRow(const GuideRows& rows, int begin, int end, const float* from, float* to);

/// A row of the warped still, and the rows whose weighted sum is the part of it that the video can
/// show.
struct WarpedRow {
    const std::int16_t* luma;                ///< [1/32 grey level]
    std::array<const std::int16_t*, 4> low;  ///< [1/64 grey level]
    std::array<std::int16_t, 4> weights;     ///< [1/16384]
};

/// Detail of the still that the video cannot show, times LookUpRows::share, plus `learned` (may be
/// null) times the rest of the share. All [1/32 grey level]. The still's detail is preferred to the
/// learned residual: with the residual everywhere, less that of the still, synthetic scenes lost
/// 0.3 to 0.7 dB, because it also sharpens differences of the sensors' blur and noise.
void detailRow(const WarpedRow& warped, const LookUpRows& lookUp, const std::int16_t* learned,
               int begin, int end, std::int16_t* to);

/// Cross-fades a row of detail to that of a second still, by how much larger its share is: see
/// params::kSecondFrom.
void fadeRow(const std::int16_t* second, const LookUpRows& secondLookUp, const LookUpRows& lookUp,
             int begin, int end, std::int16_t* inOut);

/// Rows of the video at the output's width [1/64 grey level], by channel, from the top.
using EnlargedRows = std::array<std::array<const std::int16_t*, 4>, 3>;

/// RGBA8: weighted sum of four rows, with weights [1/16384], plus `added` [1/32 grey level] in each
/// channel. `added` may be null.
void composeRow(const EnlargedRows& rows, const std::array<std::int16_t, 4>& weights,
                const std::int16_t* added, int begin, int end, std::uint32_t* to);

/// A picture in RGBA8 with 64 readable bytes after each row.
struct BlendPicture {
    const std::uint32_t* data;
    std::ptrdiff_t pitch;
    Size size;
};

/// Blends the picture, read bilinearly, over `inOut`; LookUpRows::share in [0, 1] is its opacity.
void blendRow(const BlendPicture& picture, const LookUpRows& lookUp, int begin, int end,
              std::uint32_t* inOut);

}  // namespace mfar::simd
