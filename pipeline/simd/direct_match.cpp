#include "pipeline/simd/direct_match.h"

#include "pipeline/engine/params/flow.h"
#include "pipeline/engine/params/weigh.h"
#include "pipeline/flow/cell_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/simd/direct_match.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// These must come after foreach_target.h, because they are compiled once per instruction set.
#include "pipeline/simd/still_blocks-inl.h"
#include "pipeline/simd/still_pixel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mfar::simd::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kSide = kPatchSide;
constexpr float kMiddle = 1.5F;  // centre of a cell, from its first pixel
constexpr int kAcross = params::kPatchSamples * kSide;
constexpr float kPerSample = 1.0F / params::kPatchSamples;

struct Vector {
    float x = 0, y = 0;
};
using Pixels = std::array<float, kSide * kSide>;

/// Position of a patch in the still: the position of the patch's centre, and the change of the
/// position per video pixel along x and along y [still px].
struct Place {
    Vector centre, alongX, alongY;
};

void order(float& a, float& b) {
    const float low = std::min(a, b);
    b = std::max(a, b);
    a = low;
}

/// Returns the median of 3x3 values, as flow_direct.comp does. Unlike std::nth_element(), it allows
/// NaN among them.
float medianOf(std::array<float, 9> v) {
    for (int c = 0; c < 3; ++c) {
        order(v[c], v[c + 3]);
        order(v[c + 3], v[c + 6]);
        order(v[c], v[c + 3]);
    }
    float low = std::max({v[0], v[1], v[2]}), high = std::min({v[6], v[7], v[8]});
    float middle = std::max(std::min(v[3], v[4]), std::min(std::max(v[3], v[4]), v[5]));
    order(low, middle);
    order(middle, high);
    return std::max(low, middle);
}

struct Likeness {
    float covariance = 0, varianceVideo = 0, varianceStill = 0;
    float ncc2 = 0;
};

class Cell {
public:
    Cell(const DirectMatch& in, int column, int row) : in_(in), column_(column), row_(row) {
        slopeX_ = slope(2, 0);
        slopeY_ = slope(0, 2);
    }

    /// Returns the cell's flow along the epipolar line, smoothed over the neighbouring cells; see
    /// params::kPairReach.
    [[nodiscard]] Vector line() const {
        const Vector middle = median();
        Vector sum;
        float weight = 1;
        constexpr int kReach = params::kCleanUpRadius;
        for (int j = 0; j <= kReach; ++j)
            for (int i = j == 0 ? 1 : -kReach; i <= kReach; ++i) {
                if (!isInside(i, j) || !isInside(-i, -j)) continue;
                const Vector a = at(i, j), b = at(-i, -j);
                const float x = 0.5F * (a.x + b.x) - middle.x, y = 0.5F * (a.y + b.y) - middle.y;
                const float off = (x * x + y * y) / (params::kPairReach * params::kPairReach);
                const float near = off < 1 ? 1 - off : 0;
                if (near == 0) continue;
                weight += near;
                sum.x += near * x;
                sum.y += near * y;
            }
        return {middle.x + sum.x / weight, middle.y + sum.y / weight};
    }

    void loadVideo() {
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const int px = std::min(patchStart(column_, size().width) + x, size().width - 1);
                const int py = std::min(patchStart(row_, size().height) + y, size().height - 1);
                video_[kSide * y + x] = params::kLumaRed * in_.video.row(0, py)[px] +
                                        params::kLumaGreen * in_.video.row(1, py)[px] +
                                        params::kLumaBlue * in_.video.row(2, py)[px];
            }
        removeMean(video_);
    }

    /// Compares the patch at the flow `u` with the still. All results are 0 if the patch's centre
    /// is outside the still.
    [[nodiscard]] Likeness compare(Vector u) const {
        const Place place = placeOf(u);
        const LensParams& still = in_.lookUp.still;
        if (!(place.centre.x >= 0 && place.centre.x <= still.width - 1 && place.centre.y >= 0 &&
              place.centre.y <= still.height - 1))
            return {};
        Pixels seen;
        sample(place, seen);
        removeMean(seen);
        Likeness out;
        for (std::size_t i = 0; i < seen.size(); ++i) {
            out.covariance += video_[i] * seen[i];
            out.varianceVideo += video_[i] * video_[i];
            out.varianceStill += seen[i] * seen[i];
        }
        const float noise = params::kPatchPixels * (in_.noise * in_.noise + params::kByteVariance);
        const float both = std::max(out.covariance, 0.0F);
        out.ncc2 = both * both / ((out.varianceVideo + noise) * (out.varianceStill + noise));
        return out;
    }

private:
    [[nodiscard]] Size size() const { return in_.video.size(); }
    [[nodiscard]] bool isInside(int i, int j) const {
        const int x = column_ + i, y = row_ + j;
        return x >= 0 && y >= 0 && x < in_.cells.width && y < in_.cells.height;
    }
    [[nodiscard]] Vector at(int i, int j) const {
        const int x = std::clamp(column_ + i, 0, in_.cells.width - 1);
        const int y = std::clamp(row_ + j, 0, in_.cells.height - 1);
        const auto& u = in_.lines[static_cast<std::size_t>(y) * in_.cells.width + x];
        return {u[0], u[1]};
    }

    [[nodiscard]] Vector median() const {
        std::array<float, 9> x, y;
        for (int k = 0; k < 9; ++k) {
            const Vector u = at(k % 3 - 1, k / 3 - 1);
            x[k] = u.x;
            y[k] = u.y;
        }
        return {medianOf(x), medianOf(y)};
    }

    /// Change of the flow per pixel, see flow_cells.glsl.
    [[nodiscard]] Vector slope(int i, int j) const {
        const int c = std::clamp(column_, i, std::max(in_.cells.width - 1 - i, i)) - column_;
        const int r = std::clamp(row_, j, std::max(in_.cells.height - 1 - j, j)) - row_;
        const Vector before = at(c - i, r - j), here = at(c, r), after = at(c + i, r + j);
        return {slopeOf(before.x, here.x, after.x), slopeOf(before.y, here.y, after.y)};
    }

    [[nodiscard]] Place placeOf(Vector u) const {
        HWY_ALIGN std::array<float, kChunk> x, y;
        const auto right = static_cast<float>(patchShift(column_, size().width));
        const auto down = static_cast<float>(patchShift(row_, size().height));
        const float px = static_cast<float>(kCell * column_) + kMiddle + right + u.x +
                         right * slopeX_.x + down * slopeY_.x;
        const float py = static_cast<float>(kCell * row_) + kMiddle + down + u.y +
                         right * slopeX_.y + down * slopeY_.y;
        x.fill(px);
        y.fill(py);
        x[1] += kCell * (1 + slopeX_.x);
        y[1] += kCell * slopeX_.y;
        x[2] += kCell * slopeY_.x;
        y[2] += kCell * (1 + slopeY_.y);
        const D d;
        for (std::size_t i = 0; i < 3; i += hn::Lanes(d)) {
            const Point p = StillPixel(in_.lookUp, hn::Load(d, &x[i]), hn::Load(d, &y[i]));
            hn::Store(p.x, d, &x[i]);
            hn::Store(p.y, d, &y[i]);
        }
        const auto along = [&](int i) {
            return Vector{(x[i] - x[0]) / kCell, (y[i] - y[0]) / kCell};
        };
        return {{x[0], y[0]}, along(1), along(2)};
    }

    /// Computes the still's mean over each pixel of the patch.
    void sample(const Place& place, Pixels& out) const {
        const hn::ScalableTag<float> d;
        const StillBlocks blocks(in_.still);
        HWY_ALIGN std::array<float, kAcross + hn::MaxLanes(d)> sums;
        // Distance of the first sample from the patch's centre [video px].
        constexpr float kFirst = -0.5F * kSide + 0.5F * kPerSample;
        for (int y = 0; y < kAcross; ++y) {
            const float down = kFirst + kPerSample * static_cast<float>(y);
            if (y % params::kPatchSamples == 0) sums.fill(0);
            for (std::size_t x = 0; x < kAcross; x += hn::Lanes(d)) {
                const auto across = hn::MulAdd(hn::Iota(d, static_cast<float>(x)),
                                               hn::Set(d, kPerSample), hn::Set(d, kFirst));
                const auto along = [&](float centre, float perX, float perY) HWY_ATTR {
                    return hn::MulAdd(across, hn::Set(d, perX), hn::Set(d, centre + down * perY));
                };
                const Positions at = PositionsWithin(
                    in_.still.size, along(place.centre.x, place.alongX.x, place.alongY.x),
                    along(place.centre.y, place.alongX.y, place.alongY.y));
                const auto four = MeanOfFour(blocks.at(at.x, at.y), at);
                hn::StoreU(hn::Add(hn::LoadU(d, &sums[x]), four), d, &sums[x]);
            }
            if ((y + 1) % params::kPatchSamples != 0) continue;
            constexpr float kScale = 1.0F / 256 * kPerSample * kPerSample;
            for (int x = 0; x < kSide; ++x) {
                float sum = 0;
                for (int k = 0; k < params::kPatchSamples; ++k)
                    sum += sums[params::kPatchSamples * x + k];
                out[y / params::kPatchSamples * kSide + x] = kScale * sum;
            }
        }
    }

    static void removeMean(Pixels& pixels) {
        float sum = 0;
        for (const float v : pixels)
            sum += v;
        for (float& v : pixels)
            v -= sum / params::kPatchPixels;
    }

    const DirectMatch& in_;
    int column_, row_;
    Vector slopeX_, slopeY_;
    Pixels video_{};
};

bool isDoubtful(const DirectMatch& in, const FlowCell& flow, const ErrorCell& error) {
    return error.error < params::kNotShown && flow.texture > in.leastTexture &&
           (flow.cost > params::kGoodCost || error.error > 0);
}

void matchCell(Cell& cell, FlowCell& flow, ErrorCell& error) {
    cell.loadVideo();
    Likeness best = cell.compare({flow.x, flow.y});
    const Vector line = cell.line();
    const float x = line.x - flow.x, y = line.y - flow.y;
    if (x * x + y * y > params::kSameFlow * params::kSameFlow) {
        const Likeness other = cell.compare(line);
        if (other.ncc2 > best.ncc2 + params::kClearlyAlike) {
            best = other;
            flow.x = line.x;
            flow.y = line.y;
        }
    }
    const float known = std::max(1 - flow.cost, 0.0F);
    if (!(best.ncc2 > known * known)) return;
    const float cost = 1 - std::sqrt(best.ncc2);
    const float most = std::max(cost - params::kGoodCost, 0.0F) * params::kErrorPerCost;
    error = {std::min(error.error, most), best.covariance, best.varianceVideo, best.varianceStill};
}

}  // namespace

void MatchDirectly(const DirectMatch& in, int row, int first, int end, FlowCell* flow,
                   ErrorCell* errors) {
    for (int column = first; column < end; ++column) {
        const std::size_t i = static_cast<std::size_t>(row) * in.cells.width + column;
        if (!isDoubtful(in, flow[i], errors[i])) continue;
        Cell cell(in, column, row);
        matchCell(cell, flow[i], errors[i]);
    }
}

}  // namespace mfar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mfar::simd {

HWY_EXPORT(MatchDirectly);

void matchDirectly(const DirectMatch& in, int row, int first, int end, FlowCell* flow,
                   ErrorCell* errors) {
    HWY_DYNAMIC_DISPATCH(MatchDirectly)(in, row, first, end, flow, errors);
}

}  // namespace mfar::simd
#endif
