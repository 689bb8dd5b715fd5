#pragma once

#include "base/rows.h"
#include "pipeline/simd/resample_kernels.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace mfar::simd {

/// Four rows of the source and their weights [1/16384] for one row of the result. The weights add
/// up to one.
struct ColumnTaps {
    std::array<int, 4> rows;
    std::array<std::int16_t, 4> weights;
};

/// A table for resampling a row (the source) to another length (the result). Entry x of the result
/// is the weighted sum of taps() successive entries of the source, from first(x) on. The centre of
/// entry x is at (x + 0.5) * step - 0.5 in the source, where step = (length of the source) /
/// (length of the result). Beyond the ends of the source, its outermost entries are repeated. The
/// table also resamples columns; the entries are then rows.
class RowTaps {
public:
    /// Keys' cubic with a = -0.75, as in cubic.glsl.
    [[nodiscard]] static RowTaps cubic(int from, int to);
    [[nodiscard]] static RowTaps linear(int from, int to);
    /// Linear interpolation, with a `step` that may differ from the ratio of the lengths.
    [[nodiscard]] static RowTaps linear(int from, int to, double step);
    /// A tent filter that is as wide as two entries of the result, as in still_reduce.frag. `to`
    /// must not exceed `from`.
    [[nodiscard]] static RowTaps tent(int from, int to);
    /// Mean of four linearly interpolated samples, as in still_seen.glsl. `footprint`: four
    /// times the distance between two samples [entries of the result].
    [[nodiscard]] static RowTaps mean(int from, int to, double footprint);

    [[nodiscard]] int taps() const { return weights_.size().height; }
    [[nodiscard]] int first(int x) const { return first_[0][x]; }
    [[nodiscard]] float weight(int tap, int x) const { return weights_[tap][x]; }
    /// Returns the taps of row y, for a table that is used for columns and has at most four taps.
    [[nodiscard]] const ColumnTaps& column(int y) const { return columns_[y]; }
    /// Returns the table for resampleRow(). The row passed there must have at least taps() entries;
    /// a shorter row must be padded with zeros.
    [[nodiscard]] TapTable table() const {
        return {first_[0], weights_[0], weights_.pitch(), taps()};
    }

private:
    /// Adds a sample of the source to an entry of the result. Arguments: the sample's index, which
    /// may be beyond the source's ends, and its weight.
    using Add = std::function<void(int, double)>;
    RowTaps(int from, int to, const std::function<void(int, const Add&)>& sample);

    [[nodiscard]] ColumnTaps columnOf(int y) const;

    AlignedRows<std::int32_t> first_;
    AlignedRows<float> weights_;
    std::vector<ColumnTaps> columns_;
};

}  // namespace mfar::simd
