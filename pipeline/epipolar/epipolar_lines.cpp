// Member functions of EpipolarSearch that work on labels (candidates of s, counted in steps). They
// compute matching costs along epipolar lines, and refine the best label to a position between
// labels.
#include "pipeline/epipolar/epipolar_search.h"

namespace mfar {
namespace {

// If normalError() is at most this distance [px of the pyramid level], the pixels beside an
// epipolar line are not searched.
constexpr double kNoSlack = 0.5;

simd::LabelRow rowOf(const EpipolarLens& lens, int y) {
    const auto width = static_cast<std::size_t>(lens.size().width), first = y * width;
    return {lens.raysX().data() + first, lens.raysY().data() + first, width};
}

}  // namespace

simd::LabelLines EpipolarSearch::linesOf(int index) const {
    const Level& level = levels_[index];
    return {level.lens.lens(),
            translation_.x(),
            translation_.y(),
            translation_.z(),
            static_cast<float>(level.origin.x),
            static_cast<float>(level.origin.y),
            static_cast<float>((1 << index) / pixelsPerUnit_)};
}

void EpipolarSearch::placeLabels(int index) {
    Level& level = levels_[index];
    const simd::LabelLines lines = linesOf(index);
    workers_->forRange(level.lens.size().height, 8, [&](int firstRow, int lastRow) {
        for (int y = firstRow; y < lastRow; ++y) {
            const auto first = static_cast<std::size_t>(y) * level.lens.size().width;
            simd::labelPlaces(lines, rowOf(level.lens, y), valleys_.data() + first,
                              level.labels.data() + first);
        }
    });
}

void EpipolarSearch::costRow(int index, int vectors, int y, std::uint8_t* out) const {
    const Level& level = levels_[index];
    const auto first = static_cast<std::size_t>(y) * level.lens.size().width;
    simd::labelCosts(linesOf(index), rowOf(level.lens, y), level.base.data() + first,
                     level.videoCensus.data() + first, {level.stillCensus.data(), level.still.size},
                     vectors, hasSlack(index), out);
}

bool EpipolarSearch::hasSlack(int index) const {
    return normalError_ > kNoSlack * (1 << index);
}

}  // namespace mfar
