#include "pipeline/simd/warped_still.h"

#include "pipeline/engine/params/detail.h"

#include <algorithm>
#include <cmath>

namespace mfar::simd {
namespace {

/// Taps of the mean over a video pixel along one axis. The warped still is read linearly once more,
/// which widens what a pixel sees: the samples lie closer, so that their spread is as without.
RowTaps meanOf(int output, int video) {
    constexpr double kWidened = 2.0 + 2.0 / 15;  // spread of a tent over that of four samples
    const double pitch = static_cast<double>(video) / output, seen = params::kSeen;
    return RowTaps::mean(output, video,
                         std::sqrt(std::max(seen * seen - kWidened * pitch * pitch, 0.0)));
}

/// Rows from a row of detail to the last that it looks at, at most.
int rowsLookedAt(const RowTaps& mean, const RowTaps& cubic, Size video, Size output) {
    int most = mean.taps();
    for (int y = 0; y < output.height; ++y) {
        const int last = std::min(cubic.first(y) + cubic.taps(), video.height) - 1;
        const int end = std::min(mean.first(last) + mean.taps(), output.height);
        most = std::max(most, end - y);
    }
    return most;
}

}  // namespace

WarpedStillTaps::WarpedStillTaps(Size video, Size output)
    : meanRows(meanOf(output.width, video.width)), meanColumns(meanOf(output.height, video.height)),
      cubicRows(RowTaps::cubic(video.width, output.width)),
      cubicColumns(RowTaps::cubic(video.height, output.height)),
      kept(rowsLookedAt(meanColumns, cubicColumns, video, output)) {}

WarpedStill::WarpedStill(Size video, Size output, const WarpedStillTaps& taps)
    : video_(video), output_(output), lookUps_(cellsOf(video), output.width),
      warpedRows_(taps.kept), luma_({output.width, taps.kept}), column_({output.width, 1}),
      mean_({video.width, 1}), low_({output.width, 4}) {
    const std::size_t most = static_cast<std::size_t>(output.width) / 2 + 1;
    for (PixelSpans* spans : {&covered_, &means_, &warped_})
        spans->reserve(most);
    weighed_.reserve(taps.meanColumns.taps());
    weights_.reserve(taps.meanColumns.taps());
}

void WarpedStill::begin(const StillPairs& still, Rows<const LookUpCell> lookUps,
                        const LookUpTaps& lookUpTaps, const WarpedStillTaps& taps,
                        const PixelSpan& pixels) {
    still_ = still;
    taps_ = &taps;
    covered_.clear();
    means_.clear();
    warped_.clear();
    spread(pixels);
    lookUps_.begin(lookUps, lookUpTaps, false, warped_.front().begin, warped_.front().end);
    means_.clear();
    warped_.clear();
}

// Adds what a span needs.
void WarpedStill::spread(const PixelSpan& span) {
    const RowTaps &cubic = taps_->cubicRows, &mean = taps_->meanRows;
    const int first = cubic.first(span.begin),
              last = std::min(cubic.first(span.end - 1) + cubic.taps(), video_.width) - 1;
    append(means_, {first, last + 1});
    append(warped_, {std::min(mean.first(first), span.begin),
                     std::max(std::min(mean.first(last) + mean.taps(), output_.width), span.end)});
}

void WarpedStill::cover(const PixelSpans& pixels) {
    const bool known = contains(covered_, pixels);
    if (pixels == covered_) return;
    covered_ = pixels;
    means_.clear();
    warped_.clear();
    for (const PixelSpan& span : covered_)
        spread(span);
    if (known) return;
    std::ranges::fill(warpedRows_, -1);
    lowRows_.fill(-1);
}

void WarpedStill::warp(int y) {
    const int slot = y % taps_->kept;
    if (warpedRows_[slot] == y) return;
    const LookUpRows lookUps = lookUps_.row(y);
    for (const PixelSpan& span : warped_)
        warpRow(still_, lookUps, span.begin, span.end, luma_[slot]);
    warpedRows_[slot] = y;
}

// What the video would show of the still in one of its rows, at the output's width.
void WarpedStill::makeLow(int row) {
    const RowTaps& columns = taps_->meanColumns;
    weighed_.clear();
    weights_.clear();
    for (int k = 0; k < columns.taps(); ++k) {
        const float weight = columns.weight(k, row);
        if (weight == 0) continue;
        const int y = columns.first(row) + k;
        warp(y);
        weighed_.push_back(luma_[y % taps_->kept]);
        weights_.push_back(weight);
    }
    const int slot = row % 4;
    for (const PixelSpan& span : warped_)
        weighRows(weighed_.data(), weights_.data(), static_cast<int>(weighed_.size()), span.begin,
                  span.end, column_[0]);
    for (const PixelSpan& span : means_)
        resampleRow(column_[0], taps_->meanRows.table(), span.begin, span.end, mean_[0]);
    for (const PixelSpan& span : covered_)
        resampleRow(mean_[0], taps_->cubicRows.table(), span.begin, span.end, 2, low_[slot]);
    lowRows_[slot] = row;
}

WarpedRow WarpedStill::row(int y) {
    const ColumnTaps taps = taps_->cubicColumns.column(y);
    WarpedRow out{nullptr, {}, taps.weights};
    for (std::size_t k = 0; k < taps.rows.size(); ++k) {
        const int slot = taps.rows[k] % 4;
        if (lowRows_[slot] != taps.rows[k]) makeLow(taps.rows[k]);
        out.low[k] = low_[slot];
    }
    warp(y);
    out.luma = luma_[y % taps_->kept];
    return out;
}

}  // namespace mfar::simd
