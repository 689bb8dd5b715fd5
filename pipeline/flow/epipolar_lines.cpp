// Where labels lie on epipolar lines: what they cost there, and what lies between them.
#include "pipeline/flow/census_costs.h"
#include "pipeline/flow/epipolar_search.h"

#include <cmath>

namespace mfar {
namespace {

constexpr double kNoSlack = 0.5;  // [px of a level]

/// How far along a way of one label the pixel nearest to a point lies [labels]; none where the way
/// is too short to tell.
float footOf(EpipolarLens::Point p, EpipolarLens::Point way) {
    constexpr float kLeast = 0.1F;  // [px^2]
    const float square = way.x * way.x + way.y * way.y;
    const float x = std::floor(p.x + 0.5F) - p.x, y = std::floor(p.y + 0.5F) - p.y;
    return square > kLeast ? (x * way.x + y * way.y) / square : 0.0F;
}

}  // namespace

// The costs of a label are those of the pixel nearest to its point, up to 0.7 px beside it. So the
// label that fits is the one whose point is the foot of that pixel on the line.
void EpipolarSearch::undoRounding(int index) {
    Level& level = levels_[index];
    const int width = level.lens.size().width;
    const auto perLabel = static_cast<float>((1 << index) / pixelsPerUnit_);
    workers_->forRange(level.lens.size().height, 8, [&](int firstRow, int lastRow) {
        std::vector<float> whole(width);
        std::vector<EpipolarLens::Point> here(width), next(width);
        for (int y = firstRow; y < lastRow; ++y) {
            const auto first = static_cast<std::size_t>(y) * width;
            float* label = level.labels.data() + first;
            for (int x = 0; x < width; ++x)
                whole[x] = std::floor(label[x]);
            const auto labelAt = [&](int x) { return whole[x]; };
            placeRow(level, first, perLabel, labelAt, here);
            placeRow(level, first, perLabel, [&](int x) { return labelAt(x) + 1; }, next);
            for (int x = 0; x < width; ++x) {
                const float part = label[x] - whole[x];
                const EpipolarLens::Point way{next[x].x - here[x].x, next[x].y - here[x].y};
                label[x] += (1 - part) * footOf(here[x], way) + part * footOf(next[x], way);
            }
        }
    });
}

void EpipolarSearch::costRow(const Level& level, int index, int vectors, int y,
                             std::uint8_t* out) const {
    const Size size = level.lens.size();
    const auto first = static_cast<std::size_t>(y) * size.width;
    const float perLabel = static_cast<float>((1 << index) / pixelsPerUnit_);
    std::vector<EpipolarLens::Point> from(size.width), to(size.width);
    const std::int16_t* base = level.base.data() + first;
    const bool slack = hasSlack(index);
    for (int v = 0; v < vectors; ++v) {
        const int low = SemiGlobal::kLabels * v, high = low + SemiGlobal::kLabels - 1;
        const auto labelled = [&](int label) {
            return [=](int x) { return static_cast<float>(base[x] + label); };
        };
        placeRow(level, first, perLabel, labelled(low), from);
        placeRow(level, first, perLabel, labelled(high), to);
        for (int x = 0; x < size.width; ++x) {
            std::uint8_t* costs =
                out + static_cast<std::size_t>(x * vectors + v) * SemiGlobal::kLabels;
            const std::uint32_t own = level.videoCensus[first + x];
            const std::uint32_t* still = level.stillCensus.data();
            costsAlong(from[x], to[x], own, still, level.still.size, costs);
            if (slack) takeLesserBeside(from[x], to[x], own, still, level.still.size, costs);
        }
    }
}

bool EpipolarSearch::hasSlack(int index) const {
    return normalError_ > kNoSlack * (1 << index);
}

// Where the canvas shows a row's pixels under their labels.
template <class LabelAt>
void EpipolarSearch::placeRow(const Level& level, std::size_t first, float perLabel,
                              LabelAt labelAt, std::vector<EpipolarLens::Point>& out) const {
    const EpipolarLens& lens = level.lens;
    const float tx = translation_.x(), ty = translation_.y(), tz = translation_.z();
    const auto ox = static_cast<float>(level.origin.x), oy = static_cast<float>(level.origin.y);
    const int width = lens.size().width;
    EpipolarLens::Point* to = out.data();
    for (int x = 0; x < width; ++x) {
        const float s = perLabel * labelAt(x);
        const float rx = lens.rayX(first + x), ry = lens.rayY(first + x);
        const auto p = lens.project(rx + s * (tx - rx * tz), ry + s * (ty - ry * tz));
        to[x] = {p.x - ox, p.y - oy};
    }
}

}  // namespace mfar
