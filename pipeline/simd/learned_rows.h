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

/// The class LearnedRows computes the residual that the learned enlarger adds to Keys' cubic
/// enlargement, row by row at the output's size. Each thread has its own object.
class LearnedRows {
public:
    LearnedRows(Size picture, int outputWidth);

    /// Starts with a new picture. `pixels`: columns of the output; all later arguments of cover()
    /// must be inside.
    void begin(const RgbPlanes& picture, const LearnedTaps& taps, const FilterBank& bank,
               const PixelSpan& pixels);
    /// Sets the columns of the output that later calls of row() compute. Initially, there are none.
    void cover(const PixelSpans& pixels);
    /// Returns the residual in row y of the output [1/32 grey level], in the columns set by
    /// cover(). The result is valid until the next call.
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
    // within_: output columns given to begin(). columns_: columns of the picture that are read to
    // compute the output columns within_.
    PixelSpan within_{}, columns_{};
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
