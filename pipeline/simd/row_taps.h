#pragma once

#include "base/rows.h"
#include "pipeline/simd/resample_kernels.h"

#include <array>
#include <cstdint>
#include <functional>

namespace mfar::simd {

/// Rows and their weights [1/16384], whose sum is 1.
struct ColumnTaps {
    std::array<int, 4> rows;
    std::array<std::int16_t, 4> weights;
};

/// A resampling table: entry x of the result is the weighted sum of `taps` entries of the source
/// from first(x). Source entries beyond the ends repeat the outermost ones; the table includes
/// that. Positions refer to entry centres: x of the result lies at (x + 0.5) step - 0.5 of the
/// source. The same table serves the rows of a column.
class RowTaps {
public:
    /// Keys' cubic with a = -0.75, as cubic.glsl.
    [[nodiscard]] static RowTaps cubic(int from, int to);
    [[nodiscard]] static RowTaps linear(int from, int to);
    /// Linear, with a step that differs from the ratio of the lengths.
    [[nodiscard]] static RowTaps linear(int from, int to, double step);
    /// A tent as wide as two entries of the result, as in still_reduce.frag; `to` is at most
    /// `from`.
    [[nodiscard]] static RowTaps tent(int from, int to);
    /// Mean of four linear samples a quarter of `footprint` result entries apart, as in
    /// superres_sharpen.frag.
    [[nodiscard]] static RowTaps mean(int from, int to, double footprint);

    [[nodiscard]] int taps() const { return weights_.size().height; }
    [[nodiscard]] int first(int x) const { return first_[0][x]; }
    [[nodiscard]] float weight(int tap, int x) const { return weights_[tap][x]; }
    /// Taps for the rows of a column; the table must have at most four taps.
    [[nodiscard]] ColumnTaps column(int y) const;
    /// For resampleRow(). Sources must have at least taps() entries, or zeros in place of missing
    /// ones.
    [[nodiscard]] TapTable table() const {
        return {first_[0], weights_[0], weights_.pitch(), taps()};
    }

private:
    /// Callback for an index of the source, which may be beyond its ends, and its weight.
    using Add = std::function<void(int, double)>;
    RowTaps(int from, int to, const std::function<void(int, const Add&)>& sample);

    AlignedRows<std::int32_t> first_;
    AlignedRows<float> weights_;
};

}  // namespace mfar::simd
