#include "pipeline/simd/look_up_rows.h"

#include "pipeline/flow/cell_field.h"

#include <algorithm>

namespace mfar::simd {
namespace {

// Largest valid offset [still px] and weight of a LookUpCell; larger values count as 0. No still is
// so large that it needs a larger offset.
constexpr float kFarthest = 1e5F, kMostWeight = 4;

RowTaps cellTaps(int cells, int video, int output) {
    return RowTaps::linear(cells, output, static_cast<double>(video) / output / kCell);
}

float stepOf(double still, double video, int videoPixels, int pixels) {
    return static_cast<float>(still / video * videoPixels / pixels);
}

/// Returns, for each column of cells, the first output column whose position, in cells, is at least
/// the column's number plus `offset`.
std::vector<int> firstFrom(double offset, int cells, int video, int output) {
    std::vector<int> out;
    const double perPixel = static_cast<double>(video) / output / kCell;
    int x = 0;
    for (int c = 0; c < cells; ++c) {
        while (x < output && (x + 0.5) * perPixel - 0.5 < c + offset)
            ++x;
        out.push_back(x);
    }
    out.push_back(output);
    return out;
}

}  // namespace

LookUpTaps::LookUpTaps(const StereoRig& stillRig, Size output)
    : rows(cellTaps(cellsOf(stillRig.video.size).width, stillRig.video.size.width, output.width)),
      columns(
          cellTaps(cellsOf(stillRig.video.size).height, stillRig.video.size.height, output.height)),
      cells(cellsOf(stillRig.video.size)),
      stepX(stepOf(stillRig.still.fx, stillRig.video.fx, stillRig.video.size.width, output.width)),
      stepY(
          stepOf(stillRig.still.fy, stillRig.video.fy, stillRig.video.size.height, output.height)),
      rightOf(firstFrom(0, cells.width, stillRig.video.size.width, output.width)),
      nearTo(firstFrom(-0.5, cells.width, stillRig.video.size.width, output.width)) {}

void LookUpRowCache::begin(Rows<const LookUpCell> field, const LookUpTaps& taps, bool confident,
                           int begin, int end) {
    field_ = field;
    taps_ = &taps;
    confident_ = confident;
    begin_ = begin;
    end_ = end;
    // The cells that are nearest to an output pixel, and one more on each side.
    const auto cellOf = [&](int x) {
        return static_cast<int>(std::ranges::upper_bound(taps.nearTo, x) - taps.nearTo.begin()) - 1;
    };
    firstCell_ = std::max(cellOf(begin) - 1, 0);
    lastCell_ = std::min(cellOf(end - 1) + 1, taps.cells.width - 1);
    cells_.begin(field, taps.rows, begin, end);
    nearestRows_.fill(-1);
}

LookUpRowCache::Channels LookUpRowCache::channelsOf(const LookUpCell& cell) const {
    return {boundedOr0(cell.x, -kFarthest, kFarthest), boundedOr0(cell.y, -kFarthest, kFarthest),
            confident_ ? boundedOr0(cell.confidence(), 0, 1)
                       : boundedOr0(cell.weight, 0, kMostWeight)};
}

/// Returns a row of cells, enlarged to the output's width. Where the flow jumps to the right
/// neighbour, the nearer cell replaces the interpolated values.
LookUpRowCache::Wide LookUpRowCache::enlarged(int row) {
    const auto amend = [&](const std::array<float*, kChannels>& to) {
        const LookUpCell* cells = field_[row];
        for (int c = firstCell_; c < lastCell_; ++c) {
            if (!cells[c].jumpsRight()) continue;
            const int first = std::max(taps_->rightOf[c], begin_),
                      last = std::min(taps_->rightOf[c + 1], end_),
                      middle = std::clamp(taps_->nearTo[c + 1], first, std::max(first, last));
            const Channels left = channelsOf(cells[c]), right = channelsOf(cells[c + 1]);
            for (int k = 0; k < kChannels && first < last; ++k) {
                std::fill(to[k] + first, to[k] + middle, left[k]);
                std::fill(to[k] + middle, to[k] + last, right[k]);
            }
        }
    };
    return cells_.row(row, [this](const LookUpCell& cell) { return channelsOf(cell); }, amend);
}

bool LookUpRowCache::jumpsBelow(int row) const {
    const LookUpCell* cells = field_[row];
    return std::any_of(cells + firstCell_, cells + lastCell_ + 1,
                       [](const LookUpCell& cell) { return cell.jumpsBelow(); });
}

/// Returns the row `far`, in which the values of the row `near` replace those of the columns whose
/// nearest cell in `upperRow` jumps to the cell below.
LookUpRowCache::Wide LookUpRowCache::withNearest(int upperRow, const Wide& far, const Wide& near,
                                                 int slot) {
    Wide out;
    for (int k = 0; k < kChannels; ++k) {
        float* to = nearest_[kChannels * slot + k];
        out[k] = to;
        if (nearestRows_[slot] == upperRow) continue;
        std::copy(far[k] + begin_, far[k] + end_, to + begin_);
        for (int c = firstCell_; c <= lastCell_; ++c) {
            const int first = std::max(taps_->nearTo[c], begin_),
                      last = std::min(taps_->nearTo[c + 1], end_);
            if (field_[upperRow][c].jumpsBelow() && first < last)
                std::copy(near[k] + first, near[k] + last, to + first);
        }
    }
    nearestRows_[slot] = upperRow;
    return out;
}

LookUpRows LookUpRowCache::row(int y) {
    const BetweenRows between(taps_->columns, y);
    Wide upper = enlarged(between.rows[0]), lower = enlarged(between.rows[1]);
    if (jumpsBelow(between.rows[0])) {
        const int slot = 2 * (between.rows[0] % (kKept / 2));
        if (between.t < 0.5F)
            lower = withNearest(between.rows[0], lower, upper, slot);
        else
            upper = withNearest(between.rows[0], upper, lower, slot + 1);
    }
    return {{upper[0], lower[0]},
            {upper[1], lower[1]},
            {upper[2], lower[2]},
            between.t,
            taps_->stepX,
            0.5F * taps_->stepX - 0.5F,
            (static_cast<float>(y) + 0.5F) * taps_->stepY - 0.5F};
}

}  // namespace mfar::simd
