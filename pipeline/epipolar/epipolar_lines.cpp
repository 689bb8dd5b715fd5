// Where labels lie on epipolar lines: what they cost there, and what lies between them.
#include "pipeline/epipolar/census_costs.h"
#include "pipeline/epipolar/epipolar_search.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

constexpr double kNoSlack = 0.5;  // [px of a level]

constexpr float kLeastWay = 0.1F;  // of one label, squared [px^2]

/// A label's pixel: where its costs are from.
struct LabelPixel {
    float x, y;
    float foot;  ///< the label whose point is nearest to it [labels from the best]
};

/// The next pixel on one side of the best label's.
struct ValleySide {
    float foot = 0;
    int rise = Valley::kUnknown;
};

/// The pixel nearest to the point of the label `k` from the best, which lies at `p`.
LabelPixel pixelOf(EpipolarLens::Point p, EpipolarLens::Point way, int k) {
    const auto from = static_cast<float>(k);
    const float x = std::floor(p.x + from * way.x + 0.5F);
    const float y = std::floor(p.y + from * way.y + 0.5F);
    return {x, y, ((x - p.x) * way.x + (y - p.y) * way.y) / (way.x * way.x + way.y * way.y)};
}

/// The valley's bottom [labels from the best]. Costs belong to pixels: two labels that are nearest
/// to the same one tell no more than one of them, and it counts where its foot is on the line.
float bottomOf(const Valley& valley, EpipolarLens::Point p, EpipolarLens::Point way) {
    const LabelPixel best = pixelOf(p, way, 0);
    const auto beside = [&](int side) {
        for (const int k : {side, 2 * side}) {
            const LabelPixel pixel = pixelOf(p, way, k);
            if (pixel.x != best.x || pixel.y != best.y)
                return ValleySide{pixel.foot, valley.rise[k < 0 ? k + 2 : k + 1]};
        }
        return ValleySide{};
    };
    const ValleySide left = beside(-1), right = beside(1);
    if (left.rise == Valley::kUnknown || right.rise == Valley::kUnknown) return best.foot;
    const auto leftRise = static_cast<float>(left.rise), rightRise = static_cast<float>(right.rise);
    const float leftSlope = leftRise / (best.foot - left.foot);
    const float rightSlope = rightRise / (right.foot - best.foot);
    if (!(std::max(leftSlope, rightSlope) > 0)) return best.foot;
    return rightSlope > leftSlope ? 0.5F * (left.foot + best.foot + leftRise / rightSlope)
                                  : 0.5F * (right.foot + best.foot - rightRise / leftSlope);
}

}  // namespace

// The costs of a label are those of the pixel nearest to its point, up to 0.7 px beside it.
void EpipolarSearch::placeLabels(int index) {
    Level& level = levels_[index];
    const int width = level.lens.size().width;
    const auto perLabel = static_cast<float>((1 << index) / pixelsPerUnit_);
    workers_->forRange(level.lens.size().height, 8, [&](int firstRow, int lastRow) {
        std::vector<EpipolarLens::Point> here(width), next(width);
        for (int y = firstRow; y < lastRow; ++y) {
            const auto first = static_cast<std::size_t>(y) * width;
            const Valley* valleys = valleys_.data() + first;
            const auto bestAt = [&](int x) { return static_cast<float>(valleys[x].label); };
            placeRow(level, first, perLabel, bestAt, here);
            placeRow(level, first, perLabel, [&](int x) { return bestAt(x) + 1; }, next);
            for (int x = 0; x < width; ++x) {
                const EpipolarLens::Point way{next[x].x - here[x].x, next[x].y - here[x].y};
                const bool tells = way.x * way.x + way.y * way.y > kLeastWay;
                level.labels[first + x] =
                    tells ? bestAt(x) + bottomOf(valleys[x], here[x], way) : vertexOf(valleys[x]);
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
