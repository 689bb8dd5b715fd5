#include "pipeline/simd/learned_rows.h"

#include "pipeline/simd/enlarge_rows.h"

#include <algorithm>

namespace mfar::simd {
namespace {

using enlarge::kGrid;

constexpr int kReach = 3;

}  // namespace

LearnedTaps::LearnedTaps(Size picture, Size output)
    : rows(RowTaps::linear(kGrid * picture.width, output.width)),
      columns(RowTaps::linear(kGrid * picture.height, output.height)) {}

LearnedRows::LearnedRows(Size picture, int outputWidth)
    : size_(picture), luma_({picture.width + 2 * kMargin, kKept}),
      sums_({picture.width + 2 * kMargin, 3}), mixed_({kGrid * picture.width, 1}),
      classes_({picture.width, 2}), range_({picture.width, 2}),
      grid_({kGrid * picture.width, 2 * kGrid}), wide_({outputWidth, 1}) {
    covered_.reserve(static_cast<std::size_t>(outputWidth) / 2 + 1);
    made_.reserve(covered_.capacity());
}

void LearnedRows::begin(const RgbPlanes& picture, const LearnedTaps& taps, const FilterBank& bank,
                        const PixelSpan& pixels) {
    picture_ = &picture;
    taps_ = &taps;
    bank_ = &bank;
    within_ = pixels;
    columns_ = {taps.rows.first(pixels.begin) / kGrid,
                std::min((taps.rows.first(pixels.end - 1) + 1) / kGrid + 1, size_.width)};
    covered_.clear();
    made_.clear();
    kept_.fill(-1);
    loaded_.fill(-1);
}

void LearnedRows::cover(const PixelSpans& pixels) {
    if (pixels == covered_) return;
    covered_ = pixels;
    kept_.fill(-1);
    made_.clear();
    for (const PixelSpan& span : covered_) {
        const int begin = taps_->rows.first(span.begin) / kGrid,
                  end = std::min((taps_->rows.first(span.end - 1) + 1) / kGrid + 1, size_.width);
        append(made_, {begin, end});
    }
}

const std::int16_t* LearnedRows::row(int y) {
    const RowTaps& columns = taps_->columns;
    const int first = columns.first(y), second = std::min(first + 1, kGrid * size_.height - 1);
    const auto gridRow = [&](int row) {
        const int from = row / kGrid, slot = from % 2;
        if (kept_[slot] != from) make(from);
        return grid_[slot * kGrid + row % kGrid];
    };
    const std::int16_t *a = gridRow(first), *b = gridRow(second);
    for (const PixelSpan& span : made_)
        mixedRow(a, b, columns.weight(1, y), kGrid * span.begin, kGrid * span.end, mixed_[0]);
    for (const PixelSpan& span : covered_)
        resampleRow(mixed_[0], taps_->rows.table(), span.begin, span.end, 1, wide_[0]);
    return wide_[0];
}

void LearnedRows::load(int row, std::int16_t* to) {
    const int from = std::max(columns_.begin - kReach, 0),
              end = std::min(columns_.end + kReach, size_.width);
    lumaEighthsRow({picture_->row(0, row), picture_->row(1, row), picture_->row(2, row)}, from, end,
                   to);
    if (from == 0) std::fill_n(to - kReach, kReach, to[0]);
    if (end == size_.width) std::fill_n(to + end, kReach, to[end - 1]);
}

const std::int16_t* LearnedRows::luma(int row) {
    const int at = std::clamp(row, 0, size_.height - 1), slot = at % kKept;
    std::int16_t* out = luma_[slot] + kMargin;
    if (loaded_[slot] != at) load(at, out);
    loaded_[slot] = at;
    return out;
}

void LearnedRows::make(int row) {
    std::array<const std::int16_t*, 7> rows{};
    for (int k = 0; k < 7; ++k)
        rows[k] = luma(row + k - kReach);
    const std::array<const std::int16_t*, 5> inner{rows[1], rows[2], rows[3], rows[4], rows[5]};
    const Rows<const std::int16_t> gradient = bank_->gradient(), curvature = bank_->curvature();
    const FilterRows filters{gradient.data, curvature.data, bank_->cubic(), gradient.pitch,
                             curvature.pitch};
    const int slot = row % 2;
    std::int16_t* to = grid_[slot * kGrid];
    const std::ptrdiff_t pitch = grid_.pitch();
    const auto sums = [&](int i) { return sums_[i] + kMargin; };
    for (const auto& [begin, end] : made_) {
        classRow(rows, begin, end, {sums(0), sums(1), sums(2)}, classes_[0], classes_[1]);
        rangeRow(inner, begin, end, range_[0], range_[1]);
        residualRows({inner, classes_[0], classes_[1], range_[0], range_[1]}, filters, begin, end,
                     {to, to + pitch, to + 2 * pitch, to + 3 * pitch});
    }
    kept_[slot] = row;
}

}  // namespace mfar::simd
