#pragma once

#include "base/image_view.h"
#include "pipeline/engine/params/detail.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

// These functions process pixels [begin, end) of an output row. They may read and write up to 64
// bytes beyond `end`, but write rows of the RGBA8 picture only up to `end`.

/// The positions at which the output pixels of a row read the still. They are interpolated between
/// two rows of LookUpCells that are already enlarged to the output's width. All numbers are finite.
struct LookUpRows {
    std::array<const float*, 2> x, y;   ///< LookUpCell::x and y, offset of a position [still px]
    std::array<const float*, 2> share;  ///< weight of the still's detail; in mode Blend, confidence
                                        ///< of its match
    float t;                            ///< interpolation weight of the second row, [0, 1]
    /// Position of output pixel i before the offset is added: (stepX * i + startX, startY) [still
    /// px].
    float stepX, startX, startY;
};

/// A still's luma. Each entry holds a pixel in its low byte and the pixel below in its high byte,
/// so that a block of 2x2 pixels is 32 bits. 64 readable bytes follow each row.
struct StillPairs {
    const std::uint16_t* data;
    std::ptrdiff_t pitch;
    Size size;
};

/// Interpolates the still's luma bilinearly at the positions of a row [1/32 grey level].
void warpRow(const StillPairs& still, const LookUpRows& lookUp, int begin, int end,
             std::int16_t* to);

/// Input of guideRow(): rows of values at the video's pixels, around the row to correct. Each row
/// has kGuideReach more values on both sides.
struct GuideRows {
    static constexpr int kRows = 2 * params::kGuideReach + 1;
    /// differences: still minus video, each multiplied by its factor in Guidance. trusted: 1 where
    /// the still is trusted. Where it is not, both are 0.
    std::array<const float*, kRows> differences;
    std::array<const float*, kRows> trusted;
};

/// Corrects `from`, a row of the still at the video's resolution. Where the still is trusted, a
/// pixel is reduced by its difference minus the mean of the trusted differences around it. All
/// values have the same unit.
void guideRow(const GuideRows& rows, int begin, int end, const float* from, float* to);

/// A row of the warped still [1/32 grey level], and the part of it that the video can show. This
/// part is the weighted sum of four rows of the still, reduced to the video's resolution and
/// enlarged again [1/64 grey level; weights in 1/16384].
struct WarpedRow {
    const std::int16_t* luma;
    std::array<const std::int16_t*, 4> low;
    std::array<std::int16_t, 4> weights;
};

/// Writes the still's detail, which the video cannot show, times its weight LookUpRows::share. Adds
/// `learned`, the residual of the learned filters, times 1 - weight (0 for weights above 1); null:
/// no residual. All values are in 1/32 grey level. If the whole residual is added everywhere and
/// the still's residual subtracted, 0.3 to 0.7 dB are lost on synthetic scenes: differences in blur
/// and noise between the sensors are then sharpened, too.
void detailRow(const WarpedRow& warped, const LookUpRows& lookUp, const std::int16_t* learned,
               int begin, int end, std::int16_t* to);

/// Fades from the first still's detail (`inOut`) to the second still's detail. The share of the
/// second still grows with the difference of both weights; see params::kSecondFrom.
void fadeRow(const std::int16_t* second, const LookUpRows& secondLookUp, const LookUpRows& lookUp,
             int begin, int end, std::int16_t* inOut);

/// Four consecutive video rows for each colour channel, enlarged to the output's width [1/64 grey
/// level].
using EnlargedRows = std::array<std::array<const std::int16_t*, 4>, 3>;

/// Writes a row of the RGBA8 output. Each colour channel is the weighted sum of its four rows plus
/// `added` [1/32 grey level]; null: nothing is added. `weights`: weights of the rows [1/16384].
void composeRow(const EnlargedRows& rows, const std::array<std::int16_t, 4>& weights,
                const std::int16_t* added, int begin, int end, std::uint32_t* to);

/// A picture in RGBA8. 64 readable bytes follow each row.
struct BlendPicture {
    const std::uint32_t* data;
    std::ptrdiff_t pitch;
    Size size;
};

/// Interpolates the picture bilinearly and blends it over `inOut`. The opacity of the picture is
/// LookUpRows::share, which must be in [0, 1].
void blendRow(const BlendPicture& picture, const LookUpRows& lookUp, int begin, int end,
              std::uint32_t* inOut);

}  // namespace mfar::simd
