#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/plan/rgb_planes.h"
#include "pipeline/simd/look_up_rows.h"
#include "pipeline/simd/pixel_spans.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mfar::simd {

/// Tables for the still as the video would show it. All threads share them.
struct WarpedStillTaps {
    WarpedStillTaps(Size video, Size output);

    RowTaps meanRows, meanColumns;    ///< resample output pixels to video pixels
    RowTaps cubicRows, cubicColumns;  ///< resample video pixels to output pixels
    /// Number of output rows that the detail of a row reads, from that row to the last one read:
    /// without guidance (`kept`), and with it.
    int kept, keptGuided;
};

/// The still as seen by the camera of this frame, and its detail, which the video cannot show.
/// Detail is the warped still minus its mean over each video pixel, which is enlarged again. The
/// mean is taken over the pixels of this frame, because aliasing depends on their position.
/// Compared with detail that is computed once per still, this gains 0.5 dB on photographs and 0.5
/// to 0.9 dB on synthetic scenes. Rows at the output's size are computed on request. Each thread
/// has its own object.
class WarpedStill {
public:
    WarpedStill(Size video, Size output, const WarpedStillTaps& taps);

    /// The video that a still guides, and the strength of the guidance.
    struct Guide {
        const RgbPlanes& video;
        Guidance guidance;
    };

    /// Starts with a new still and a new field of look-ups. `pixels`: columns of the output that
    /// cover() may choose from. No pixels are computed until cover() is called.
    void begin(const StillPairs& still, Rows<const LookUpCell> lookUps,
               const LookUpTaps& lookUpTaps, const WarpedStillTaps& taps, const PixelSpan& pixels,
               const Guide& guide);
    /// From now on, row() computes only these columns. `pixels` must be ascending.
    void cover(const PixelSpans& pixels);
    /// Returns the detail of the covered pixels of a row; valid until the next call. Rows must be
    /// requested in ascending order.
    [[nodiscard]] WarpedRow row(int y);
    /// Returns the look-up positions of a row, and the weight of the detail.
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
    PixelSpans means_, warped_;    // means_: columns of the video; warped_: pixels of the output
    PixelSpans compared_;          // columns of the video: means_; with guidance, more on each side
    std::vector<int> warpedRows_;  // output row stored in each slot of luma_
    std::array<int, 4> lowRows_{};
    std::vector<const std::int16_t*> weighed_;
    std::vector<float> weights_;
    AlignedRows<std::int16_t> luma_;    // slots_ rows of the output [1/32 grey level]
    AlignedRows<float> column_, mean_;  // column_: a row of the output; mean_: a row of the video
    AlignedRows<std::int16_t> low_;     // four rows at the output's width [1/64 grey level]

    const RgbPlanes* guide_ = nullptr;  // null: no guidance
    Guidance guidance_;
    Rows<const LookUpCell> field_{};
    int slots_ = 0;                                   // number of rows of luma_ in use
    std::array<int, GuideRows::kRows> comparedRows_;  // video row stored in each slot of seen_
    AlignedRows<std::int16_t> videoLuma_;             // a row of the video [1/8 grey level]
    // Buffers of GuideRows::kRows rows. Each row has a margin and belongs to a row of the video
    // (comparedRows_). Unit of grey levels: 1/32. See GuideRows.
    AlignedRows<float> seen_, differences_, trusted_;
};

}  // namespace mfar::simd
