#include "pipeline/simd/look_up_rows.h"

#include "pipeline/flow/cell_field.h"

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

}  // namespace

LookUpTaps::LookUpTaps(const StereoRig& stillRig, Size output)
    : rows(cellTaps(cellsOf(stillRig.video.size).width, stillRig.video.size.width, output.width)),
      columns(
          cellTaps(cellsOf(stillRig.video.size).height, stillRig.video.size.height, output.height)),
      cells(cellsOf(stillRig.video.size)),
      stepX(stepOf(stillRig.still.fx, stillRig.video.fx, stillRig.video.size.width, output.width)),
      stepY(stepOf(stillRig.still.fy, stillRig.video.fy, stillRig.video.size.height,
                   output.height)) {}

void LookUpRowCache::begin(Rows<const LookUpCell> field, const LookUpTaps& taps, bool confident,
                           int begin, int end) {
    taps_ = &taps;
    confident_ = confident;
    cells_.begin(field, taps.rows, begin, end);
}

LookUpRows LookUpRowCache::row(int y) {
    const auto channels = [this](const LookUpCell& cell) {
        return std::array{boundedOr0(cell.x, -kFarthest, kFarthest),
                          boundedOr0(cell.y, -kFarthest, kFarthest),
                          confident_ ? boundedOr0(cell.confidence, 0, 1)
                                     : boundedOr0(cell.weight, 0, kMostWeight)};
    };
    const BetweenRows between(taps_->columns, y);
    const auto upper = cells_.row(between.rows[0], channels),
               lower = cells_.row(between.rows[1], channels);
    return {{upper[0], lower[0]},
            {upper[1], lower[1]},
            {upper[2], lower[2]},
            between.t,
            taps_->stepX,
            0.5F * taps_->stepX - 0.5F,
            (static_cast<float>(y) + 0.5F) * taps_->stepY - 0.5F};
}

}  // namespace mfar::simd
