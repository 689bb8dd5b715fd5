#pragma once

#include "base/image_view.h"
#include "pipeline/engine/params/detail.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

// Rows of the output, pixels [begin, end). Rows of fields may be read and written up to 64 bytes
// behind `end`; of the output nothing else is written.

/// Where the pixels of a row look: two rows of the look-up field at the output's width and the
/// position in between. Finite numbers.
struct LookUpRows {
    std::array<const float*, 2> x, y;   ///< [still px], as LookUpCell
    std::array<const float*, 2> share;  ///< weight of the detail, or confidence
    float t;                            ///< 0: the first row, 1: the second
    /// Position without the field: (stepX px + startX, startY) [still px].
    float stepX, startX, startY;
};

/// A still's luma, a pixel and the one below it (high byte) together: four neighbours lie in 32
/// bits. 64 readable bytes behind each row.
struct StillPairs {
    const std::uint16_t* data;
    std::ptrdiff_t pitch;  ///< pairs from one row to the next
    Size size;
};

/// The still's luma where the pixels look, read bilinearly [1/32 grey level].
void warpRow(const StillPairs& still, const LookUpRows& lookUp, int begin, int end,
             std::int16_t* to);

/// What guidance adds to a row of the video and takes away (Guidance), and where the still is
/// trusted. Rows of the video's pixels with a margin of kGuideReach on both sides.
struct GuideRows {
    static constexpr int kRows = 2 * params::kGuideReach + 1;
    std::array<const float*, kRows> differences;  ///< zero where not trusted
    std::array<const float*, kRows> trusted;      ///< 1 or 0
};

/// A row of the still as the video shows it, less the trusted differences, which count from their
/// mean around. All in the same unit.
void guideRow(const GuideRows& rows, int begin, int end, const float* from, float* to);

/// A row of the warped still, and the rows whose weighed sum is what the video shows of it.
struct WarpedRow {
    const std::int16_t* luma;                ///< [1/32 grey level]
    std::array<const std::int16_t*, 4> low;  ///< [1/64 grey level]
    std::array<std::int16_t, 4> weights;     ///< [1/16384]
};

/// What the video cannot show of the still, by LookUpRows::share. Plus `learned` by the share that
/// this leaves of one; null: nothing. All [1/32 grey level]. The still knows better what it shows:
/// with the residual everywhere, and the still's own taken off its detail, synthetic scenes lost
/// 0.3 to 0.7 dB, as differences between both sensors' blur and noise are sharpened, too.
void detailRow(const WarpedRow& warped, const LookUpRows& lookUp, const std::int16_t* learned,
               int begin, int end, std::int16_t* to);

/// Fades a row of detail over to that of a second still, as far as it counts for more: see
/// params::kSecondFrom.
void fadeRow(const std::int16_t* second, const LookUpRows& secondLookUp, const LookUpRows& lookUp,
             int begin, int end, std::int16_t* inOut);

/// Rows of the video at the output's width [1/64 grey level], by channel, from the top.
using EnlargedRows = std::array<std::array<const std::int16_t*, 4>, 3>;

/// RGBA8 of the sum of four rows, times weights [1/16384], and `added` [1/32 grey level] to each
/// channel. `added` may be null.
void composeRow(const EnlargedRows& rows, const std::array<std::int16_t, 4>& weights,
                const std::int16_t* added, int begin, int end, std::uint32_t* to);

/// A picture in RGBA8 with 64 readable bytes behind each row.
struct BlendPicture {
    const std::uint32_t* data;
    std::ptrdiff_t pitch;
    Size size;
};

/// Mixes the picture, read bilinearly, over what is there, by LookUpRows::share in [0, 1].
void blendRow(const BlendPicture& picture, const LookUpRows& lookUp, int begin, int end,
              std::uint32_t* inOut);

}  // namespace mfar::simd
