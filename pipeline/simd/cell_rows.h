#pragma once

#include "base/rows.h"
#include "pipeline/simd/row_taps.h"

#include <algorithm>
#include <array>

namespace mfar::simd {

/// The class CellRows enlarges rows of cells to the width of a picture. Values are interpolated
/// linearly between the cells' centres, and are constant beyond the outermost centres. Four
/// successive enlarged rows are kept, so that they are computed only once. Count: number of
/// channels per cell.
template <class Cell, std::size_t Count>
class CellRows {
public:
    using Channels = std::array<float, Count>;
    using Wide = std::array<const float*, Count>;

    CellRows(int cells, int width)
        : planar_({cells, Count}), wide_({width, kKept * static_cast<int>(Count)}) {}

    void begin(Rows<const Cell> field, const RowTaps& taps, int begin, int end) {
        field_ = field;
        taps_ = &taps;
        begin_ = begin;
        end_ = end;
        rows_.fill(-1);
    }
    /// Returns the enlarged row y of cells. `channelsOf` must convert a cell to finite numbers.
    /// `amend(channels)` may change the row's channels after they are interpolated.
    template <class ChannelsOf, class Amend>
    [[nodiscard]] Wide row(int y, const ChannelsOf& channelsOf, const Amend& amend) {
        const int slot = y % kKept, first = slot * static_cast<int>(Count);
        std::array<float*, Count> channels;
        Wide out;
        for (std::size_t c = 0; c < Count; ++c)
            out[c] = channels[c] = wide_[first + static_cast<int>(c)];
        if (rows_[slot] != y) {
            fill(y, first, channelsOf);
            amend(channels);
        }
        rows_[slot] = y;
        return out;
    }
    template <class ChannelsOf>
    [[nodiscard]] Wide row(int y, const ChannelsOf& channelsOf) {
        return row(y, channelsOf, [](const std::array<float*, Count>&) {});
    }

private:
    static constexpr int kKept = 4;

    template <class ChannelsOf>
    void fill(int y, int first, const ChannelsOf& channelsOf) {
        const Cell* cells = field_[y];
        const int last = std::min(taps_->first(end_ - 1) + taps_->taps(), field_.size.width);
        for (int x = taps_->first(begin_); x < last; ++x) {
            const Channels values = channelsOf(cells[x]);
            for (std::size_t c = 0; c < Count; ++c)
                planar_[static_cast<int>(c)][x] = values[c];
        }
        for (int c = 0; c < static_cast<int>(Count); ++c)
            resampleRow(planar_[c], taps_->table(), begin_, end_, wide_[first + c]);
    }

    Rows<const Cell> field_;
    const RowTaps* taps_ = nullptr;
    int begin_ = 0, end_ = 0;
    std::array<int, kKept> rows_{};
    AlignedRows<float> planar_, wide_;
};

struct BetweenRows {
    BetweenRows(const RowTaps& taps, int y)
        : rows{taps.first(y), taps.first(y) + (taps.taps() > 1 ? 1 : 0)},
          t(taps.taps() > 1 ? taps.weight(1, y) : 0) {}

    std::array<int, 2> rows;
    float t;
};

[[nodiscard]] inline float boundedOr0(float value, float least, float most) {
    return value >= least && value <= most ? value : 0;
}

}  // namespace mfar::simd
