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

/// Tables for taking the residual's grid to the output's size, shared by all threads.
struct LearnedTaps {
    LearnedTaps(Size picture, Size output);

    RowTaps rows, columns;
};

/// What the learned enlarger adds to a picture that Keys' cubic enlarges: rows at the output's
/// size, each made from the picture's rows when it is asked for. Scratch of one thread.
class LearnedRows {
public:
    LearnedRows(Size picture, int outputWidth);

    /// Starts with a picture, for these pixels of the output alone. Nothing is covered then.
    void begin(const RgbPlanes& picture, const LearnedTaps& taps, const FilterBank& bank,
               const PixelSpan& pixels);
    /// The only pixels whose residual is asked for from now on, ascending.
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
    PixelSpan within_{}, columns_{};  // of the output; of the picture, what they need
    PixelSpans covered_;              // pixels of the output
    PixelSpans made_;                 // columns of the picture
    std::array<int, 2> kept_{};       // rows of the picture whose residual is there
    std::array<int, kKept> loaded_{};
    AlignedRows<std::int16_t> luma_;      // kKept rows with a margin
    AlignedRows<float> sums_, mixed_;     // three rows with a margin; a row of the grid
    AlignedRows<std::uint16_t> classes_;  // a row of each kind
    AlignedRows<std::int16_t> range_;     // lowest and highest
    AlignedRows<std::int16_t> grid_;      // residual of two rows: eight of the grid
    AlignedRows<std::int16_t> wide_;      // a row of the output
};

}  // namespace mfar::simd
