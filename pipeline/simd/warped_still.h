#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/plan/rgb_planes.h"
#include "pipeline/simd/look_up_rows.h"
#include "pipeline/simd/pixel_spans.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mfar::simd {

/// Tables for what the video would show of a still, shared by all threads.
struct WarpedStillTaps {
    WarpedStillTaps(Size video, Size output);

    RowTaps meanRows, meanColumns;    ///< from the output to the video's pixels
    RowTaps cubicRows, cubicColumns;  ///< and back
    /// Output rows from one to the last that its detail needs, and that guided detail needs.
    int kept, keptGuided;
};

/// The still as this frame's camera sees it, and what of it the video cannot show: the still,
/// warped, less its own mean over each of the video's pixels, enlarged again. The mean is taken in
/// this frame's pixels: aliasing depends on where these lie. Against a detail made once per still,
/// that gains 0.5 dB on photographs and 0.5 to 0.9 dB on synthetic scenes. Rows at the output's
/// size, each made when it is asked for. Scratch of one thread.
class WarpedStill {
public:
    WarpedStill(Size video, Size output, const WarpedStillTaps& taps);

    /// The video that a still guides, and how far.
    struct Guide {
        const RgbPlanes& video;
        Guidance guidance;
    };

    /// Starts with a still and a field of look-ups, for these pixels of the output alone. Nothing
    /// is covered then.
    void begin(const StillPairs& still, Rows<const LookUpCell> lookUps,
               const LookUpTaps& lookUpTaps, const WarpedStillTaps& taps, const PixelSpan& pixels,
               const Guide& guide);
    /// The only pixels that are asked for from now on, ascending.
    void cover(const PixelSpans& pixels);
    /// In the covered pixels; valid until the next call. Rows ascend.
    [[nodiscard]] WarpedRow row(int y);
    /// Where its pixels look, and what share of the detail counts.
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
    PixelSpans means_, warped_;    // columns of the video, pixels of the output
    PixelSpans compared_;          // columns of the video: `means_`, where guided with those around
    std::vector<int> warpedRows_;  // the row that each slot holds
    std::array<int, 4> lowRows_{};
    std::vector<const std::int16_t*> weighed_;
    std::vector<float> weights_;
    AlignedRows<std::int16_t> luma_;    // taps.kept rows [1/32 grey level]
    AlignedRows<float> column_, mean_;  // a row of the output; of the video
    AlignedRows<std::int16_t> low_;     // four rows at the output's width [1/64 grey level]

    const RgbPlanes* guide_ = nullptr;  // null: nothing is guided
    Guidance guidance_;
    Rows<const LookUpCell> field_{};
    int slots_ = 0;                                   // rows of luma_ in use
    std::array<int, GuideRows::kRows> comparedRows_;  // the row that each slot holds
    AlignedRows<std::int16_t> videoLuma_;             // a row [1/8 grey level]
    // Rows of the video with a margin, by slot [1/32 grey level]; see GuideRows.
    AlignedRows<float> seen_, differences_, trusted_;
};

}  // namespace mfar::simd
