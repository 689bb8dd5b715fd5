#include "pipeline/enlarge/trusted_pairs.h"

#include "pipeline/enlarge/box_sums.h"
#include "pipeline/flow/cell_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace mfar::enlarge {
namespace {

// Of a cell that is used at all.
constexpr float kLeastWeight = 0.25F, kLeastConfidence = 0.8F;
constexpr int kBorder = 8;  // video px
// A pixel is learned from where both differ by no more than this share of the video's variance and
// the noise. A share of 0.1 costs 0.07 dB of what is learned from photographs, as look-ups that are
// off blur what the still shows.
constexpr double kMostDifference = 0.03;
constexpr double kLeastNoise = 1;  // variance [grey levels^2]
constexpr int kTrustReach = 3;     // px: of 7x7
constexpr int kMeanReach = 8;
constexpr double kMostShift = 0.5;  // video px
constexpr int kGridScale = 64;
constexpr double kStructure = 36;  // variance [grey levels^2]

/// Catmull and Rom's cubic: weights of the entries at -1 to 2.
std::array<float, 4> catmullRom(float t) {
    const float t2 = t * t, t3 = t2 * t;
    return {0.5F * (-t3 + 2 * t2 - t), 0.5F * (3 * t3 - 5 * t2 + 2), 0.5F * (-3 * t3 + 4 * t2 + t),
            0.5F * (t3 - t2)};
}

float sample(const AlignedRows<std::uint8_t>& picture, float x, float y) {
    const auto [width, height] = picture.size();
    const float floorX = std::floor(x), floorY = std::floor(y);
    const int left = static_cast<int>(floorX) - 1, top = static_cast<int>(floorY) - 1;
    const auto wx = catmullRom(x - floorX), wy = catmullRom(y - floorY);
    float out = 0;
    for (int j = 0; j < 4; ++j) {
        const std::uint8_t* row = picture[std::clamp(top + j, 0, height - 1)];
        float sum = 0;
        for (int i = 0; i < 4; ++i)
            sum += wx[i] * static_cast<float>(row[std::clamp(left + i, 0, width - 1)]);
        out += wy[j] * sum;
    }
    return out;
}

/// Most that noise alone makes both differ by, from the mean squares of 7x7 pixels each: those of a
/// fifth, where nothing else does, and a half more. Less would choose pixels by their noise.
double noiseOf(std::vector<double>& differences) {
    if (differences.empty()) return kLeastNoise;
    const auto fifth = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 5);
    std::nth_element(differences.begin(), fifth, differences.end());
    return std::max(kLeastNoise, 1.5 * *fifth);
}

/// A value between cells along one axis, of a pixel at `at` [video px].
struct BetweenCells {
    BetweenCells(double at, int count) {
        const double cell = std::clamp((at - 1.5) / kCell, 0.0, count - 1.0);
        first = std::min(static_cast<int>(cell), std::max(count - 2, 0));
        second = std::min(first + 1, count - 1);
        t = static_cast<float>(cell - first);
    }
    int first, second;
    float t;
};

}  // namespace

TrustedPairs::TrustedPairs(const MatchedPictures& pictures, std::stop_token stop)
    : in_(pictures), stop_(std::move(stop)), video_(pictures.video),
      cells_(pictures.lookUps.size()), lookUps_(cells_), known_(cells_), trusted_(video_),
      grid_({kGrid * video_.width, kGrid * video_.height}),
      low_(static_cast<std::size_t>(video_.width) * video_.height), seen_(low_.size()),
      mean_(low_.size()) {
    findCells();
    warp();
    fitTone();
    fitBlur();
    fitMean();
    shift();
    warp();
    fitTone();
    fitBlur();
    fitMean();
    if (stop_.stop_requested()) return;
    trust();
    measureSharpness();
}

void TrustedPairs::findCells() {
    for (int y = 0; y < cells_.height; ++y)
        for (int x = 0; x < cells_.width; ++x) {
            const LookUpCell& cell = in_.lookUps[y][x];
            lookUps_[y][x] = cell;
            known_[y][x] = std::isfinite(cell.x) && std::isfinite(cell.y) &&
                           cell.weight >= kLeastWeight && cell.confidence >= kLeastConfidence;
        }
}

double TrustedPairs::videoAt(int x, int y) const {
    return in_.row(y)[x] / double(kLumaScale);
}

/// The still on the grid of sub-pixels, and its mean over each pixel.
void TrustedPairs::warp() {
    // Where a sub-pixel has several pixels of the still, it is their mean.
    const int samples =
        std::max(1, static_cast<int>(std::lround(in_.scaleX * in_.stillPerX / kGrid)));
    const int perPixel = kGrid * samples;
    for (int y = 0; y < video_.height && !stop_.stop_requested(); ++y)
        for (int x = 0; x < video_.width; ++x) {
            if (known_[y / kCell][x / kCell] == 0) continue;
            float sum = 0;
            for (int phase = 0; phase < kPhases; ++phase) {
                float value = 0;
                for (int k = 0; k < samples * samples; ++k) {
                    const int column = phase % kGrid * samples + k % samples,
                              row = phase / kGrid * samples + k / samples;
                    const double px = x - 0.5 + (column + 0.5) / perPixel,
                                 py = y - 0.5 + (row + 0.5) / perPixel;
                    const BetweenCells u(px, cells_.width), v(py, cells_.height);
                    const auto between = [&](float LookUpCell::* part) {
                        const auto along = [&](int cell) {
                            const float a = lookUps_[cell][u.first].*part;
                            return a + u.t * (lookUps_[cell][u.second].*part - a);
                        };
                        const float a = along(v.first);
                        return a + v.t * (along(v.second) - a);
                    };
                    const double sx = (px + 0.5) * in_.scaleX - 0.5 + between(&LookUpCell::x);
                    const double sy = (py + 0.5) * in_.scaleY - 0.5 + between(&LookUpCell::y);
                    value += sample(in_.still, static_cast<float>((sx + 0.5) * in_.stillPerX - 0.5),
                                    static_cast<float>((sy + 0.5) * in_.stillPerY - 0.5));
                }
                value /= static_cast<float>(samples * samples);
                sum += value;
                grid_[kGrid * y + phase / kGrid][kGrid * x + phase % kGrid] =
                    static_cast<std::int16_t>(
                        std::lround(std::clamp(value, -64.0F, 320.0F) * kGridScale));
            }
            low_[at(x, y)] = sum / kPhases;
        }
}

/// The video's level as a function of the still's: linear between the means of 16 ranges.
void TrustedPairs::fitTone() {
    constexpr int kRanges = 16;
    struct Range {
        double count = 0, still = 0, video = 0;
    };
    std::array<Range, kRanges> ranges;
    for (int y = kBorder; y < video_.height - kBorder; ++y)
        for (int x = kBorder; x < video_.width - kBorder; ++x) {
            if (known_[y / kCell][x / kCell] == 0) continue;
            const float value = low_[at(x, y)];
            Range& range = ranges[std::clamp(static_cast<int>(value) / kRanges, 0, kRanges - 1)];
            ++range.count;
            range.still += value;
            range.video += videoAt(x, y);
        }
    constexpr double kLeastPixels = 100;
    std::vector<std::array<double, 2>> knots;
    for (const Range& range : ranges)
        if (range.count >= kLeastPixels)
            knots.push_back({range.still / range.count, range.video / range.count});
    tone_.assign(256, 0);
    for (int level = 0; level < 256; ++level) {
        if (knots.size() < 2) {
            tone_[level] =
                static_cast<float>(knots.empty() ? level : level + knots[0][1] - knots[0][0]);
            continue;
        }
        std::size_t i = 1;
        while (i + 1 < knots.size() && level > knots[i][0])
            ++i;
        const auto [x0, y0] = knots[i - 1];
        const auto [x1, y1] = knots[i];
        tone_[level] = static_cast<float>(y0 + (y1 - y0) * (level - x0) / (x1 - x0));
    }
}

float TrustedPairs::toneOf(float value) const {
    const float bounded = std::clamp(value, 0.0F, 255.0F);
    const int level = std::min(static_cast<int>(bounded), 254);
    return tone_[level] + (value - static_cast<float>(level)) * (tone_[level + 1] - tone_[level]);
}

/// The sensors' points spread differently, everywhere alike: a symmetric kernel of 5x5 pixels is
/// fitted, so that only what is matched wrongly counts as difference.
void TrustedPairs::fitBlur() {
    constexpr int kReach = 2, kWeights = 6;
    using Weights = Eigen::Matrix<double, kWeights, 1>;
    const auto numberOf = [](int dx, int dy) {
        const int a = std::max(std::abs(dx), std::abs(dy)),
                  b = std::min(std::abs(dx), std::abs(dy));
        return a * (a + 1) / 2 + b;
    };
    Plane toned(low_.size());
    for (std::size_t i = 0; i < low_.size(); ++i)
        toned[i] = toneOf(low_[i]);
    const auto around = [&](int x, int y) {
        Weights sums = Weights::Zero();
        for (int dy = -kReach; dy <= kReach; ++dy)
            for (int dx = -kReach; dx <= kReach; ++dx)
                sums[numberOf(dx, dy)] += toned[at(x + dx, y + dy)] - toned[at(x, y)];
        return sums;
    };
    const auto isKnown = [&](int x, int y) {
        for (const int dy : {-kReach, kReach})
            for (const int dx : {-kReach, kReach})
                if (known_[(y + dy) / kCell][(x + dx) / kCell] == 0) return false;
        return true;
    };
    Eigen::Matrix<double, kWeights, kWeights> squares;
    squares.setIdentity();
    Weights products = Weights::Zero();
    seen_ = toned;
    for (int y = kBorder; y < video_.height - kBorder && !stop_.stop_requested(); ++y)
        for (int x = kBorder; x < video_.width - kBorder; ++x) {
            if (!isKnown(x, y)) continue;
            const Weights sums = around(x, y);
            squares.noalias() += sums * sums.transpose();
            products += sums * (videoAt(x, y) - toned[at(x, y)]);
        }
    const Weights weights = squares.llt().solve(products);
    for (int y = kBorder; y < video_.height - kBorder; ++y)
        for (int x = kBorder; x < video_.width - kBorder; ++x)
            if (isKnown(x, y)) seen_[at(x, y)] += static_cast<float>(weights.dot(around(x, y)));
}

/// What the still lacks to the video's mean over larger areas.
void TrustedPairs::fitMean() {
    const auto isKnown = [&](int x, int y) { return known_[y / kCell][x / kCell] != 0; };
    const BoxSums counts(video_, [&](int x, int y) { return isKnown(x, y) ? 1.0 : 0.0; });
    const BoxSums lacks(video_, [&](int x, int y) {
        return isKnown(x, y) ? videoAt(x, y) - seen_[at(x, y)] : 0.0;
    });
    for (int y = 0; y < video_.height; ++y)
        for (int x = 0; x < video_.width; ++x) {
            const double count = counts.around(x, y, kMeanReach);
            mean_[at(x, y)] =
                static_cast<float>(count > 0 ? lacks.around(x, y, kMeanReach) / count : 0);
        }
}

/// Of each cell's pixels, what tells how far both are shifted.
std::vector<TrustedPairs::ShiftSums> TrustedPairs::shiftSums() const {
    const auto isKnown = [&](int x, int y) { return known_[y / kCell][x / kCell] != 0; };
    std::vector<ShiftSums> out(static_cast<std::size_t>(cells_.width) * cells_.height);
    for (int y = 1; y < video_.height - 1; ++y)
        for (int x = 1; x < video_.width - 1; ++x) {
            if (!isKnown(x, y) || !isKnown(x - 1, y) || !isKnown(x + 1, y) || !isKnown(x, y - 1) ||
                !isKnown(x, y + 1))
                continue;
            const double gx = double(seen_[at(x + 1, y)] - seen_[at(x - 1, y)]) / 2,
                         gy = double(seen_[at(x, y + 1)] - seen_[at(x, y - 1)]) / 2,
                         e = videoAt(x, y) - seen_[at(x, y)] - mean_[at(x, y)];
            out[static_cast<std::size_t>(y / kCell) * cells_.width + x / kCell].add(
                {gx * gx, gx * gy, gy * gy, gx * e, gy * e});
        }
    return out;
}

/// Moves the look-ups by the fraction of a pixel that makes both alike: one step of Lucas' and
/// Kanade's method over 12x12 pixels around each cell.
void TrustedPairs::shift() {
    const std::vector<ShiftSums> sums = shiftSums();
    for (int y = 0; y < cells_.height; ++y)
        for (int x = 0; x < cells_.width; ++x) {
            if (known_[y][x] == 0) continue;
            ShiftSums s;
            for (int j = std::max(y - 1, 0); j <= std::min(y + 1, cells_.height - 1); ++j)
                for (int i = std::max(x - 1, 0); i <= std::min(x + 1, cells_.width - 1); ++i)
                    s.add(sums[static_cast<std::size_t>(j) * cells_.width + i]);
            constexpr double kDamping = 400;  // [grey levels^2 / px^2]: of noise alone
            const double a = s.xx + kDamping, b = s.yy + kDamping, det = a * b - s.xy * s.xy;
            const double dx = (s.xe * b - s.ye * s.xy) / det, dy = (s.ye * a - s.xe * s.xy) / det;
            lookUps_[y][x].x +=
                static_cast<float>(std::clamp(dx, -kMostShift, kMostShift) * in_.scaleX);
            lookUps_[y][x].y +=
                static_cast<float>(std::clamp(dy, -kMostShift, kMostShift) * in_.scaleY);
        }
}

void TrustedPairs::trust() {
    const auto isKnown = [&](int x, int y) { return known_[y / kCell][x / kCell] != 0; };
    const auto known = [&](const auto& valueAt) {
        return BoxSums(video_, [&](int x, int y) { return isKnown(x, y) ? valueAt(x, y) : 0.0; });
    };
    const BoxSums counts = known([](int, int) { return 1.0; });
    const BoxSums values = known([&](int x, int y) { return videoAt(x, y); });
    const BoxSums squares = known([&](int x, int y) { return videoAt(x, y) * videoAt(x, y); });
    const BoxSums errors = known([&](int x, int y) {
        const double e = videoAt(x, y) - seen_[at(x, y)] - mean_[at(x, y)];
        return e * e;
    });
    constexpr int kAll = (2 * kTrustReach + 1) * (2 * kTrustReach + 1);
    const auto mean = [&](const BoxSums& of, int x, int y) {
        return of.around(x, y, kTrustReach) / kAll;
    };
    std::vector<double> known7x7;
    for (int y = kBorder; y < video_.height - kBorder; ++y)
        for (int x = kBorder; x < video_.width - kBorder; ++x) {
            trusted_[y][x] = isKnown(x, y) && mean(counts, x, y) > 0.999;
            if (trusted_[y][x] != 0) known7x7.push_back(mean(errors, x, y));
        }
    const double noise = noiseOf(known7x7);
    int trusted = 0;
    for (int y = kBorder; y < video_.height - kBorder; ++y)
        for (int x = kBorder; x < video_.width - kBorder; ++x) {
            if (trusted_[y][x] == 0) continue;
            const double value = mean(values, x, y), variance = mean(squares, x, y) - value * value;
            trusted_[y][x] = mean(errors, x, y) <= kMostDifference * variance + noise;
            trusted += trusted_[y][x];
        }
    trustedShare_ = double(trusted) / (double(video_.width) * video_.height);
}

Phases TrustedPairs::stillOf(int x, int y) const {
    Phases out;
    for (int phase = 0; phase < kPhases; ++phase) {
        const std::int16_t value = grid_[kGrid * y + phase / kGrid][kGrid * x + phase % kGrid];
        out[phase] = toneOf(static_cast<float>(value) / kGridScale) + mean_[at(x, y)];
    }
    return out;
}

Phases TrustedPairs::cubicOf(int x, int y) const {
    const std::int16_t* cubic = FilterBank::prior().cubic();
    Phases out = Phases::Constant(videoAt(x, y));
    for (int tap = 0; tap < kTaps; ++tap) {
        const Offset of = kTapAt[tap];
        const double step =
            double(in_.row(y + of.y)[x + of.x] - in_.row(y)[x]) / kLumaScale / kWeightScale;
        for (int phase = 0; phase < kPhases; ++phase)
            out[phase] += step * cubic[filterIndex(tap, phase)];
    }
    return out;
}

Phases TrustedPairs::target(int x, int y) const {
    return stillOf(x, y) - cubicOf(x, y);
}

void TrustedPairs::measureSharpness() {
    double still = 0, cubic = 0;
    for (int y = 0; y < video_.height; ++y)
        for (int x = 0; x < video_.width; ++x) {
            if (!trusts(x, y)) continue;
            const auto varianceOf = [](const Phases& values) {
                return (values.array() - values.mean()).square().mean();
            };
            const double ofCubic = varianceOf(cubicOf(x, y));
            if (ofCubic < kStructure) continue;
            cubic += ofCubic;
            still += varianceOf(stillOf(x, y));
        }
    sharpness_ = cubic > 0 ? still / cubic : 0;
}

}  // namespace mfar::enlarge
