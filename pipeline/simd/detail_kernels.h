#pragma once

#include "base/image_view.h"
#include "pipeline/engine/params/detail.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

// These functions process pixels [begin, end) of a row of the output. They may read and write rows
// of fields up to 64 bytes beyond `end`; rows of the output are written only up to `end`.

/// Look-up positions of the pixels of a row: two rows of the look-up field, enlarged to the
/// output's width, and the position between them. All numbers are finite.
struct LookUpRows {
    std::array<const float*, 2> x, y;   ///< [still px], see LookUpCell
    std::array<const float*, 2> share;  ///< weight of the detail, or confidence
    float t;                            ///< 0: the first row, 1: the second row
    /// Position without the look-up's offset: (stepX px + startX, startY) [still px].
    float stepX, startX, startY;
};

/// A still's luma. Each entry holds a pixel in its low byte and the pixel below in its high byte,
/// so that a block of 2x2 pixels is 32 bits. 64 readable bytes follow each row.
struct StillPairs {
    const std::uint16_t* data;
    std::ptrdiff_t pitch;  ///< entries from one row to the next
    Size size;
};

/// Samples the still's luma bilinearly at the look-up positions [1/32 grey level].
void warpRow(const StillPairs& still, const LookUpRows& lookUp, int begin, int end,
             std::int16_t* to);

/// Input of guideRow(): rows of the video's pixels, with a margin of kGuideReach on both sides.
/// `differences`: still minus video, scaled by Guidance. `trusted`: where the still is trusted.
struct GuideRows {
    static constexpr int kRows = 2 * params::kGuideReach + 1;
    std::array<const float*, kRows> differences;  ///< 0 where the still is not trusted
    std::array<const float*, kRows> trusted;      ///< 1 or 0
};

/// Writes `from`, the still as the video shows it, minus the amount by which the trusted
/// differences exceed their local mean. All values have the same unit.
void guideRow(const GuideRows& rows, int begin, int end, const float* from, float* to);

/// A row of the warped still, and the rows whose weighted sum is what the video can show of it.
struct WarpedRow {
    const std::int16_t* luma;                ///< [1/32 grey level]
    std::array<const std::int16_t*, 4> low;  ///< [1/64 grey level]
    std::array<std::int16_t, 4> weights;     ///< [1/16384]
};

/// Computes the still's detail, which the video cannot show, times LookUpRows::share, and adds
/// `learned` times the rest of the share; `learned` may be null. All values are in 1/32 grey level.
/// The still's detail has priority over the learned residual. Adding the whole residual everywhere,
/// and subtracting that of the still, lost 0.3 to 0.7 dB on synthetic scenes, because the residual
/// also sharpens the sensors' differences in blur and noise.
void detailRow(const WarpedRow& warped, const LookUpRows& lookUp, const std::int16_t* learned,
               int begin, int end, std::int16_t* to);

/// Fades a row of detail over to that of a second still, depending on how much larger its share is,
/// see params::kSecondFrom.
void fadeRow(const std::int16_t* second, const LookUpRows& secondLookUp, const LookUpRows& lookUp,
             int begin, int end, std::int16_t* inOut);

/// Four rows of the video at the output's width, from the top, for each colour channel [1/64 grey
/// level].
using EnlargedRows = std::array<std::array<const std::int16_t*, 4>, 3>;

/// Writes RGBA8: the weighted sum of four rows, with weights [1/16384], plus `added` [1/32 grey
/// level] in each channel; `added` may be null.
void composeRow(const EnlargedRows& rows, const std::array<std::int16_t, 4>& weights,
                const std::int16_t* added, int begin, int end, std::uint32_t* to);

/// A picture in RGBA8. 64 readable bytes follow each row.
struct BlendPicture {
    const std::uint32_t* data;
    std::ptrdiff_t pitch;
    Size size;
};

/// Blends the picture, interpolated bilinearly, over `inOut`. Its opacity is LookUpRows::share, in
/// [0, 1].
void blendRow(const BlendPicture& picture, const LookUpRows& lookUp, int begin, int end,
              std::uint32_t* inOut);

}  // namespace mfar::simd
