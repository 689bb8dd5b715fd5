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

/// Tables that resample the learned residual to the output's size. The residual has 4x4 values per
/// pixel of the picture. All threads share the tables.
struct LearnedTaps {
    LearnedTaps(Size picture, Size output);

    RowTaps rows, columns;
};

/// The residual that the learned enlarger adds to Keys' cubic enlargement. Rows at the output's
/// size are computed on request. Each thread has its own object.
class LearnedRows {
public:
    LearnedRows(Size picture, int outputWidth);

    /// Starts with a new picture. Nothing is computed before cover(), whose columns must all be in
    /// `pixels`.
    void begin(const RgbPlanes& picture, const LearnedTaps& taps, const FilterBank& bank,
               const PixelSpan& pixels);
    /// Limits later calls of row() to these columns of the output, which must be ascending.
    void cover(const PixelSpans& pixels);
    /// Returns the residual of the covered pixels of a row [1/32 grey level], valid until the next
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
    PixelSpan within_{}, columns_{};  // within_: output pixels given to begin(); columns_: picture
                                      // columns they need
    PixelSpans covered_;
    PixelSpans made_;
    std::array<int, 2> kept_{};
    std::array<int, kKept> loaded_{};
    AlignedRows<std::int16_t> luma_;
    AlignedRows<float> sums_, mixed_;
    AlignedRows<std::uint16_t> classes_;
    AlignedRows<std::int16_t> range_;
    AlignedRows<std::int16_t> grid_;
    AlignedRows<std::int16_t> wide_;
};

}  // namespace mfar::simd
