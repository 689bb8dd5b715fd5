#pragma once

#include "pipeline/engine/cells.h"
#include "pipeline/plan/rgb_planes.h"
#include "pipeline/simd/cell_rows.h"
#include "pipeline/simd/detail_kernels.h"

namespace mfar::simd {

/// Tables for enlarging a video, shared by all threads.
struct VideoTaps {
    VideoTaps(Size video, Size output);

    RowTaps cubicRows, cubicColumns, linearRows, linearColumns;
    RowTaps trustRows, trustColumns;  ///< from cells to the video's size
};

/// Rows of the video, sharpened, at the output's width; computed on request, the last four are
/// kept. Scratch of one thread.
class VideoRows {
public:
    VideoRows(Size video, int outputWidth);

    /// Starts a video; only pixels [begin, end) of the output are computed. `trust` without data:
    /// no sharpening.
    void begin(const RgbPlanes& video, Rows<const TrustCell> trust, const VideoTaps& taps,
               bool linear, int begin, int end);
    /// Four rows, at most three apart.
    [[nodiscard]] EnlargedRows rows(const std::array<int, 4>& videoRows);

private:
    static constexpr int kMargin = 64, kKept = 8;
    using Source = std::array<const std::uint8_t*, 5>;

    void make(int row);
    [[nodiscard]] const std::uint8_t* source(int channel, int row);
    void load(int row);
    void makeStrength(int row);

    Size video_;
    const RgbPlanes* planes_ = nullptr;
    const VideoTaps* taps_ = nullptr;
    bool sharpens_ = false;
    TapTable table_{};
    int begin_ = 0, end_ = 0;    // of the output
    int first_ = 0, last_ = 0;   // of the video
    std::array<int, 4> made_{};  // rows
    std::array<int, kKept> loaded_{};
    AlignedRows<std::uint8_t> bytes_;     // kKept rows of three channels, with a margin
    AlignedRows<float> grey_;             // a row
    AlignedRows<std::int16_t> strength_;  // a row
    AlignedRows<std::int16_t> wide_;      // four rows of three channels
    CellRows<TrustCell, 2> trust_;
};

}  // namespace mfar::simd
