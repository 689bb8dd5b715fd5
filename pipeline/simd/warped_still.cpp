#include "pipeline/simd/warped_still.h"

#include "pipeline/engine/params/detail.h"
#include "pipeline/enlarge/filter_layout.h"
#include "pipeline/flow/cell_field.h"
#include "pipeline/simd/enlarge_rows.h"

#include <algorithm>
#include <cmath>

namespace mfar::simd {
namespace {

constexpr int kReach = params::kGuideReach;
constexpr int kMargin = 16;       // [columns] on each side of a row; one cache line
constexpr float kMeanScale = 32;  // units of the mean per grey level

/// Returns the weights that average the warped still over a video pixel along one axis, as the mean
/// of four samples. Each sample is interpolated linearly, which blurs it. To make up for this blur,
/// the samples are closer together than a quarter of a video pixel. So the mean is not wider than a
/// video pixel.
RowTaps meanOf(int output, int video) {
    // Linear interpolation has a tent-shaped kernel; its variance is 1/6 of the squared distance
    // between source entries. The four positions of RowTaps::mean() have a variance of 5/64 of the
    // squared footprint. kWidened = (1/6) / (5/64).
    constexpr double kWidened = 2.0 + 2.0 / 15;
    const double pitch = static_cast<double>(video) / output, seen = params::kSeen;
    return RowTaps::mean(output, video,
                         std::sqrt(std::max(seen * seen - kWidened * pitch * pitch, 0.0)));
}

/// Returns n, the number of rows of the warped still that must be kept. The detail of output row y
/// is computed from rows of the warped still up to row y + n - 1. `reach`: number of additional
/// video rows that guidance reads.
int rowsLookedAt(const RowTaps& mean, const RowTaps& cubic, Size video, Size output, int reach) {
    int most = mean.taps();
    for (int y = 0; y < output.height; ++y) {
        const int last = std::min(cubic.first(y) + cubic.taps() + reach, video.height) - 1;
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
      kept(rowsLookedAt(meanColumns, cubicColumns, video, output, 0)),
      keptGuided(rowsLookedAt(meanColumns, cubicColumns, video, output, kReach)) {}

WarpedStill::WarpedStill(Size video, Size output, const WarpedStillTaps& taps)
    : video_(video), output_(output), lookUps_(cellsOf(video), output.width),
      warpedRows_(taps.keptGuided), luma_({output.width, taps.keptGuided}),
      column_({output.width, 1}), mean_({video.width, 1}),
      squares_({std::max(output.width, video.width), 2}), low_({output.width, 4}),
      videoLuma_({video.width, 1}), seen_({video.width + 2 * kMargin, GuideRows::kRows}),
      differences_(seen_.size()), trusted_(seen_.size()) {
    const std::size_t most = static_cast<std::size_t>(output.width) / 2 + 1;
    for (PixelSpans* spans : {&covered_, &means_, &compared_, &warped_})
        spans->reserve(most);
    weighed_.reserve(taps.meanColumns.taps());
    weights_.reserve(taps.meanColumns.taps());
}

void WarpedStill::begin(const StillPairs& still, Rows<const LookUpCell> lookUps,
                        const LookUpTaps& lookUpTaps, const WarpedStillTaps& taps,
                        const PixelSpan& pixels, const Guide& guide) {
    still_ = still;
    taps_ = &taps;
    field_ = lookUps;
    guide_ = guide.guidance.any() ? &guide.video : nullptr;
    guidance_ = guide.guidance;
    slots_ = guide_ != nullptr ? taps.keptGuided : taps.kept;
    for (PixelSpans* spans : {&covered_, &means_, &compared_, &warped_})
        spans->clear();
    spread(pixels);
    lookUps_.begin(lookUps, lookUpTaps, false, warped_.front().begin, warped_.front().end);
    for (PixelSpans* spans : {&means_, &compared_, &warped_})
        spans->clear();
}

void WarpedStill::spread(const PixelSpan& span) {
    const RowTaps &cubic = taps_->cubicRows, &mean = taps_->meanRows;
    const int first = cubic.first(span.begin),
              last = std::min(cubic.first(span.end - 1) + cubic.taps(), video_.width) - 1;
    const int reach = guide_ != nullptr ? kReach : 0;
    const int from = std::max(first - reach, 0), to = std::min(last + reach, video_.width - 1);
    append(means_, {first, last + 1});
    append(compared_, {from, to + 1});
    append(warped_, {std::min(mean.first(from), span.begin),
                     std::max(std::min(mean.first(to) + mean.taps(), output_.width), span.end)});
}

void WarpedStill::cover(const PixelSpans& pixels) {
    const bool known = contains(covered_, pixels);
    if (pixels == covered_) return;
    covered_ = pixels;
    for (PixelSpans* spans : {&means_, &compared_, &warped_})
        spans->clear();
    for (const PixelSpan& span : covered_)
        spread(span);
    if (known) return;
    std::ranges::fill(warpedRows_, -1);
    lowRows_.fill(-1);
    comparedRows_.fill(-1);
}

void WarpedStill::warp(int y) {
    const int slot = y % slots_;
    if (warpedRows_[slot] == y) return;
    const LookUpRows lookUps = lookUps_.row(y);
    for (const PixelSpan& span : warped_)
        warpRow(still_, lookUps, span.begin, span.end, luma_[slot]);
    warpedRows_[slot] = y;
}

void WarpedStill::makeMean(int row, float* to) {
    const RowTaps& columns = taps_->meanColumns;
    weighed_.clear();
    weights_.clear();
    for (int k = 0; k < columns.taps(); ++k) {
        const float weight = columns.weight(k, row);
        if (weight == 0) continue;
        const int y = columns.first(row) + k;
        warp(y);
        weighed_.push_back(luma_[y % slots_]);
        weights_.push_back(weight);
    }
    const int number = static_cast<int>(weighed_.size());
    const bool ofLight = guidance_.light > 0;
    for (const auto& [begin, end] : warped_) {
        if (ofLight)
            weighRowsAndSquares(weighed_.data(), weights_.data(), number, begin, end, column_[0],
                                squares_[0]);
        else
            weighRows(weighed_.data(), weights_.data(), number, begin, end, column_[0]);
    }
    for (const auto& [begin, end] : compared_) {
        resampleRow(column_[0], taps_->meanRows.table(), begin, end, to);
        if (!ofLight) continue;
        resampleRow(squares_[0], taps_->meanRows.table(), begin, end, squares_[1]);
        meanOfLightRow(squares_[1], guidance_.light, begin, end, to);
    }
}

void WarpedStill::compare(int row) {
    const int slot = row % GuideRows::kRows;
    if (comparedRows_[slot] == row) return;
    float* seen = seen_[slot] + kMargin;
    float *differences = differences_[slot] + kMargin, *trusted = trusted_[slot] + kMargin;
    makeMean(row, seen);
    const LookUpCell* cells = field_[row / kCell];
    const float video = guidance_.video * kMeanScale / enlarge::kLumaScale;
    for (const auto& [begin, end] : compared_) {
        lumaEighthsRow({guide_->row(0, row), guide_->row(1, row), guide_->row(2, row)}, begin, end,
                       videoLuma_[0]);
        for (int cell = begin / kCell; cell * kCell < end; ++cell)
            std::fill_n(trusted + static_cast<std::ptrdiff_t>(cell) * kCell, kCell,
                        cells[cell].weight > 0 ? 1.0F : 0.0F);
        for (int x = begin; x < end; ++x)
            differences[x] = trusted[x] * (guidance_.still * seen[x] -
                                           video * static_cast<float>(videoLuma_[0][x]));
        for (float* values : {differences, trusted}) {
            if (begin == 0) std::fill_n(values - kReach, kReach, values[0]);
            if (end == video_.width) std::fill_n(values + end, kReach, values[end - 1]);
        }
    }
    comparedRows_[slot] = row;
}

void WarpedStill::makeGuided(int row, float* to) {
    GuideRows rows{};
    for (int k = 0; k < GuideRows::kRows; ++k) {
        const int at = std::clamp(row + k - kReach, 0, video_.height - 1),
                  slot = at % GuideRows::kRows;
        compare(at);
        rows.differences[k] = differences_[slot] + kMargin;
        rows.trusted[k] = trusted_[slot] + kMargin;
    }
    for (const auto& [begin, end] : means_)
        guideRow(rows, begin, end, seen_[row % GuideRows::kRows] + kMargin, to);
}

// Computes a row of the still at the video's resolution, corrects it if there is guidance, and
// enlarges it to the output's width.
void WarpedStill::makeLow(int row) {
    if (guide_ != nullptr)
        makeGuided(row, mean_[0]);
    else
        makeMean(row, mean_[0]);
    const int slot = row % 4;
    for (const PixelSpan& span : covered_)
        resampleRow(mean_[0], taps_->cubicRows.table(), span.begin, span.end, 2, low_[slot]);
    lowRows_[slot] = row;
}

WarpedRow WarpedStill::row(int y) {
    const ColumnTaps& taps = taps_->cubicColumns.column(y);
    WarpedRow out{nullptr, {}, taps.weights};
    for (std::size_t k = 0; k < taps.rows.size(); ++k) {
        const int slot = taps.rows[k] % 4;
        if (lowRows_[slot] != taps.rows[k]) makeLow(taps.rows[k]);
        out.low[k] = low_[slot];
    }
    warp(y);
    out.luma = luma_[y % slots_];
    return out;
}

}  // namespace mfar::simd
