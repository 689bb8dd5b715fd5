// Member functions of EpipolarSearch that work on labels (candidates of s, counted in steps) or on
// values of s. They compute matching costs along epipolar lines, refine the best label to a
// position between labels, and find out which points the still shows.
#include "pipeline/epipolar/epipolar_search.h"
#include "pipeline/simd/depth_rows.h"

#include <algorithm>
#include <array>

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

void EpipolarSearch::dropUnseen(int x, int y, std::span<const float> s,
                                std::span<std::int32_t> landing) const {
    const Level& fine = levels_.front();
    const EpipolarLens& whole = lenses_.front();
    simd::Lens lens = whole.lens();
    lens.cx -= static_cast<float>(area_.x0) + static_cast<float>(fine.origin.x);
    lens.cy -= static_cast<float>(area_.y0) + static_cast<float>(fine.origin.y);
    const Eigen::Vector3f& t = translation_;
    const simd::Motion motion{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {t.x(), t.y(), t.z()}};
    std::array<std::int32_t, 512> pixels{};
    const std::size_t first = static_cast<std::size_t>(y) * whole.size().width + x;
    for (std::size_t i = 0; i < s.size(); i += pixels.size()) {
        const std::size_t count = std::min(pixels.size(), s.size() - i);
        simd::landRow(lens, fine.still.size, motion, whole.raysX().data() + first + i,
                      whole.raysY().data() + first + i, s.data() + i, count, pixels.data());
        for (std::size_t k = 0; k < count; ++k)
            if (pixels[k] < 0 || fine.seen[static_cast<std::size_t>(pixels[k])] == 0)
                landing[i + k] = -1;
    }
}

}  // namespace mfar
