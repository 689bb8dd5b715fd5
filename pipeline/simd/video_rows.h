#pragma once

#include "pipeline/engine/cells.h"
#include "pipeline/plan/rgb_planes.h"
#include "pipeline/simd/cell_rows.h"
#include "pipeline/simd/detail_kernels.h"

namespace mfar::simd {

/// Resampling tables for enlarging the video. All threads use the same tables.
struct VideoTaps {
    VideoTaps(Size video, Size output);

    RowTaps cubicRows, cubicColumns, linearRows, linearColumns;
    RowTaps trustRows, trustColumns;
};

/// Computes rows of the video, sharpened and enlarged to the output's width, when they are
/// requested. Keeps the last four rows. Each thread has its own object.
class VideoRows {
public:
    VideoRows(Size video, int outputWidth);

    /// Sets a new video frame for rows(), which will compute only columns [begin, end) of the
    /// output. If `trust` has no data, rows are not sharpened.
    void begin(const RgbPlanes& video, Rows<const TrustCell> trust, const VideoTaps& taps,
               bool linear, int begin, int end);
    /// Returns four rows of the video, enlarged to the output's width. The first and the last of
    /// them must be at most three rows apart.
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
    int begin_ = 0, end_ = 0;
    int first_ = 0, last_ = 0;  // columns of the video from which [begin_, end_) is computed
    std::array<int, 4> made_{};
    std::array<int, kKept> loaded_{};
    AlignedRows<std::uint8_t> bytes_;
    AlignedRows<float> grey_;
    AlignedRows<std::int16_t> strength_;
    AlignedRows<std::int16_t> wide_;
    CellRows<TrustCell, 2> trust_;
};

}  // namespace mfar::simd
