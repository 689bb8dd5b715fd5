#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/plan/rgb_planes.h"
#include "pipeline/simd/look_up_rows.h"
#include "pipeline/simd/pixel_spans.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mfar::simd {

/// Tables that reduce the warped still to the video's resolution and enlarge it again. All threads
/// share them.
struct WarpedStillTaps {
    WarpedStillTaps(Size video, Size output);

    RowTaps meanRows, meanColumns;    ///< reduce output pixels to video pixels
    RowTaps cubicRows, cubicColumns;  ///< enlarge video pixels to output pixels
    /// Number of rows of the warped still that must be kept to compute the detail of a row, without
    /// guidance (`kept`) and with guidance.
    int kept, keptGuided;
};

/// The still warped to the view of this frame, and its detail, which the video cannot show. To
/// compute the detail, the warped still is reduced to the video's resolution (its mean over each
/// video pixel), enlarged again and subtracted from the warped still. The mean is taken over the
/// pixels of this frame, because aliasing depends on their position. Compared with detail that is
/// computed once per still, this gains 0.5 dB on photographs and 0.5 to 0.9 dB on synthetic scenes.
/// Output rows are computed on request. Each thread has its own object.
class WarpedStill {
public:
    WarpedStill(Size video, Size output, const WarpedStillTaps& taps);

    /// The video whose finest detail the still replaces, and how strongly it does so.
    struct Guide {
        const RgbPlanes& video;
        Guidance guidance;
    };

    /// Starts with a new still and new LookUpCells. `pixels`: columns of the output that cover()
    /// may choose from. No pixels are computed until cover() is called.
    void begin(const StillPairs& still, Rows<const LookUpCell> lookUps,
               const LookUpTaps& lookUpTaps, const WarpedStillTaps& taps, const PixelSpan& pixels,
               const Guide& guide);
    /// From now on, row() computes only these columns of the output. `pixels` must be ascending.
    void cover(const PixelSpans& pixels);
    /// Returns the detail of the covered pixels of a row; valid until the next call. Rows must be
    /// requested in ascending order.
    [[nodiscard]] WarpedRow row(int y);
    /// Returns where the pixels of an output row read the still, and the weight of its detail.
    [[nodiscard]] LookUpRows lookUps(int y) { return lookUps_.row(y); }

private:
    void spread(const PixelSpan& span);
    void warp(int y);
    void makeLow(int row);
    void makeMean(int row, float* to);
    void compare(int row);
    void makeGuided(int row, float* to);

    Size video_, output_;
    StillPairs still_{};
    const WarpedStillTaps* taps_ = nullptr;
    LookUpRowCache lookUps_;
    PixelSpans covered_;
    // Columns that are computed for covered_. means_: columns of the still at the video's
    // resolution. warped_: columns of the warped still.
    PixelSpans means_, warped_;
    PixelSpans compared_;           // means_; with guidance, also kGuideReach columns on each side
    std::vector<int> warpedRows_;   // output row stored in each row of luma_
    std::array<int, 4> lowRows_{};  // video row stored in each row of low_
    std::vector<const std::int16_t*> weighed_;
    std::vector<float> weights_;
    AlignedRows<std::int16_t> luma_;  // slots_ rows of the warped still [1/32 grey level]
    // column_: a row of the warped still, reduced only vertically; mean_: the same row, reduced to
    // the video's resolution.
    AlignedRows<float> column_, mean_;
    AlignedRows<std::int16_t> low_;  // four reduced rows, enlarged to the output's width
                                     // [1/64 grey level]

    const RgbPlanes* guide_ = nullptr;  // null: no guidance
    Guidance guidance_;
    Rows<const LookUpCell> field_{};
    int slots_ = 0;                                   // number of rows of luma_ in use
    std::array<int, GuideRows::kRows> comparedRows_;  // video row stored in each row of seen_
    AlignedRows<std::int16_t> videoLuma_;             // a row of the video [1/8 grey level]
    // Buffers of GuideRows::kRows rows with a margin. comparedRows_ tells which row of the video
    // each of them belongs to. seen_ is the warped still at the video's resolution; for the others
    // see GuideRows. Luma is in units of 1/32 grey level.
    AlignedRows<float> seen_, differences_, trusted_;
};

}  // namespace mfar::simd
