#pragma once

#include "base/rows.h"
#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/plan/rgb_planes.h"
#include "pipeline/simd/pixel_spans.h"
#include "pipeline/simd/row_taps.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mfar::simd {

/// Tables that resample the learned residual to the output's size. The residual's grid has 4x4
/// points per pixel of the picture. All threads share the tables.
struct LearnedTaps {
    LearnedTaps(Size picture, Size output);

    RowTaps rows, columns;
};

/// The residual that the learned enlarger adds to a picture that was enlarged by Keys' cubic. Rows
/// at the output's size are computed on request. Each thread has its own object.
class LearnedRows {
public:
    LearnedRows(Size picture, int outputWidth);

    /// Starts with a new picture. `pixels`: columns of the output that cover() may choose from. No
    /// pixels are computed until cover() is called.
    void begin(const RgbPlanes& picture, const LearnedTaps& taps, const FilterBank& bank,
               const PixelSpan& pixels);
    /// From now on, row() computes only these columns. `pixels` must be ascending.
    void cover(const PixelSpans& pixels);
    /// Returns the residual of the covered pixels of a row [1/32 grey level]. Valid until the next
    /// call.
    [[nodiscard]] const std::int16_t* row(int y);

private:
    static constexpr int kMargin = 64, kKept = 8;

    void make(int row);
    [[nodiscard]] const std::int16_t* luma(int row);
    void load(int row, std::int16_t* to);

    Size size_;
    const RgbPlanes* picture_ = nullptr;
    const LearnedTaps* taps_ = nullptr;
    const FilterBank* bank_ = nullptr;
    PixelSpan within_{}, columns_{};  // begin()'s pixels; columns_: picture columns they need
    PixelSpans covered_;              // cover()'s pixels of the output
    PixelSpans made_;                 // columns of the picture that covered_ needs
    std::array<int, 2> kept_{};       // rows of the picture whose residual is stored
    std::array<int, kKept> loaded_{};
    AlignedRows<std::int16_t> luma_;      // kKept rows with a margin
    AlignedRows<float> sums_, mixed_;     // sums_: three rows with a margin; mixed_: a grid row
    AlignedRows<std::uint16_t> classes_;  // a row of classes by gradient, a row by curvature
    AlignedRows<std::int16_t> range_;     // smallest and largest luma around each pixel of a row
    AlignedRows<std::int16_t> grid_;      // residual of two rows of pixels: eight rows of the grid
    AlignedRows<std::int16_t> wide_;      // residual of a row of the output
};

}  // namespace mfar::simd
