#pragma once

#include "base/image_view.h"
#include "pipeline/engine/params/detail.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

// These functions process pixels [begin, end) of an output row; guideRow() processes a row of the
// video. They may read and write up to 64 bytes beyond `end`, but write rows of the RGBA8 picture
// only up to `end`.

/// Positions at which the output pixels of a row read the still. They are interpolated between two
/// rows of LookUpCells, which are already enlarged to the output's width. All numbers are finite.
struct LookUpRows {
    std::array<const float*, 2> x, y;   ///< LookUpCell::x and y, the offset [still px]
    std::array<const float*, 2> share;  ///< LookUpCell::weight; mode Blend: LookUpCell::confidence
    float t;                            ///< interpolation weight of the second row, [0, 1]
    /// Position of output pixel i before the offset is added: (stepX * i + startX, startY) [still
    /// px].
    float stepX, startX, startY;
};

/// A still's luma. Each entry holds a pixel in its low byte and the pixel below it in its high
/// byte. So two successive entries are a block of 2x2 pixels. 64 readable bytes follow each row.
struct StillPairs {
    const std::uint16_t* data;
    std::ptrdiff_t pitch;
    Size size;
};

/// Writes the still's luma at the positions of a row, interpolated bilinearly [1/32 grey level].
void warpRow(const StillPairs& still, const LookUpRows& lookUp, int begin, int end,
             std::int16_t* to);

/// Input of guideRow(), which corrects one row of the still at the video's resolution: this row,
/// and kGuideReach rows above and below it. A row has one value per video pixel, and kGuideReach
/// more values on both sides.
struct GuideRows {
    static constexpr int kRows = 2 * params::kGuideReach + 1;
    /// Guidance::still * (still's luma) - Guidance::video * (video's luma); 0 if `trusted` is 0.
    std::array<const float*, kRows> differences;
    /// 1 if the pixel's LookUpCell::weight is positive, else 0.
    std::array<const float*, kRows> trusted;
};

/// Corrects `from`, a row of the still at the video's resolution: to = from - trusted * (difference
/// - mean). `trusted` and `difference` are the pixel's values in GuideRows. `mean` is the mean of
/// the differences of all trusted pixels that are at most kGuideReach pixels away along each axis.
/// `from`, `to` and the differences have the same unit.
void guideRow(const GuideRows& rows, int begin, int end, const float* from, float* to);

/// A row of the warped still, and the same row after reduction to the video's resolution and
/// enlargement: the sum of the rows `low`, each multiplied by its entry of `weights`. The still's
/// detail is the first minus the second.
struct WarpedRow {
    const std::int16_t* luma;  ///< luma of the warped still [1/32 grey level]
    /// Four rows of the still at the video's resolution, enlarged to the output's width [1/64 grey
    /// level].
    std::array<const std::int16_t*, 4> low;
    std::array<std::int16_t, 4> weights;  ///< weights of the rows in `low` [1/16384]
};

/// Writes w * (still's detail) + max(1 - w, 0) * learned [1/32 grey level]; w is LookUpRows::share.
/// `learned`: detail that the learned filters predict from the video; null: 0. Both terms contain
/// the same detail, so the factor max(1 - w, 0) keeps it from being added twice. The alternative
/// would be to omit this factor and to subtract from the still's detail what the filters predict
/// from the still. It is 0.3 to 0.7 dB worse on synthetic scenes, because it amplifies the
/// differences in blur and noise between the two sensors.
void detailRow(const WarpedRow& warped, const LookUpRows& lookUp, const std::int16_t* learned,
               int begin, int end, std::int16_t* to);

/// Replaces the first still's detail (`inOut`) gradually by the second still's detail (`second`).
/// The share of the second still's detail grows with the difference (second still's weight) -
/// (first still's weight); see params::kSecondFrom.
void fadeRow(const std::int16_t* second, const LookUpRows& secondLookUp, const LookUpRows& lookUp,
             int begin, int end, std::int16_t* inOut);

/// Four consecutive video rows for each colour channel, enlarged to the output's width [1/64 grey
/// level].
using EnlargedRows = std::array<std::array<const std::int16_t*, 4>, 3>;

/// Writes a row of the RGBA8 output. Each colour channel is the weighted sum of its four `rows`
/// plus `added`. `weights`: weights of the rows [1/16384]. `added`: [1/32 grey level]; null: 0.
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
