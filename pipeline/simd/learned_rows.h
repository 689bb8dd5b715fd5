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

/// Tables for resampling the residual's grid to the output's size, shared by all threads.
struct LearnedTaps {
    LearnedTaps(Size picture, Size output);

    RowTaps rows, columns;
};

/// The residual that the learned enlarger adds to a picture enlarged by Keys' cubic: rows at the
/// output's size, computed on request. Scratch of one thread.
class LearnedRows {
public:
    LearnedRows(Size picture, int outputWidth);

    /// Starts a picture; only these pixels of the output are computed. Clears the covered pixels.
    void begin(const RgbPlanes& picture, const LearnedTaps& taps, const FilterBank& bank,
               const PixelSpan& pixels);
    /// Limits the computation from now on to these pixels, ascending.
    void cover(const PixelSpans& pixels);
    /// Residual of a row in the covered pixels [1/32 grey level]; valid until the next call.
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
    PixelSpan within_{}, columns_{};  // within_: of the output; columns_: the picture's columns
                                      // that they need
    PixelSpans covered_;              // pixels of the output
    PixelSpans made_;                 // columns of the picture
    std::array<int, 2> kept_{};       // rows of the picture whose residual is stored
    std::array<int, kKept> loaded_{};
    AlignedRows<std::int16_t> luma_;      // kKept rows with a margin
    AlignedRows<float> sums_, mixed_;     // sums_: three rows with a margin; mixed_: a row of the
                                          // grid
    AlignedRows<std::uint16_t> classes_;  // a row of each kind of class
    AlignedRows<std::int16_t> range_;     // lowest and highest
    AlignedRows<std::int16_t> grid_;      // residual of two rows: eight of the grid
    AlignedRows<std::int16_t> wide_;      // a row of the output
};

}  // namespace mfar::simd
