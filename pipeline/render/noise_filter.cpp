#include "pipeline/render/noise_filter.h"

#include "base/large_pages.h"
#include "base/luminance.h"
#include "pipeline/render/rendered_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace mfar {
namespace {

// An unknown variance of a pixel is estimated from the pixel and from neighbours up to kSpreadReach
// steps of kSpreadStep pixels away. Sparse sampling gives samples to one pixel in 16, at distances
// of 4 pixels. If fewer than kSurely of these pixels have samples, the estimate is raised.
constexpr int kSpreadReach = 2, kSpreadStep = 4;
constexpr float kSurely = 4;
// A difference of more than this many standard errors is not noise.
constexpr float kTolerance = 2.5F;
// A sample on the shadow catcher shows either full shadow or none, because its ray is either
// blocked or not. The samples of some pixels of a penumbra all agree by chance. The filter would
// then underestimate the noise, would not average these pixels, and the penumbra would have spots.
// So kCatcherTolerance replaces kTolerance on the shadow catcher.
constexpr float kCatcherTolerance = 4;
constexpr int kBefore = 2;               // number of stages before the filter's first level
constexpr float kLeastVariance = 1e-7F;  // about (0.04 grey levels)^2 at white
// Upper limit of the relative change of depth per pixel on one surface. On the shadow catcher it is
// larger with a focal length below kFineFocal [px], where a pixel covers more of the floor.
constexpr float kDepthSlope = 0.01F;
constexpr double kFineFocal = 280;

struct Spread {
    float sum = 0, squares = 0, count = 0;

    void add(const Eigen::Array3f& light, float samples) {
        if (!(samples > 0)) return;
        const float y = luminanceOf<float>(light.matrix());
        sum += y;
        squares += y * y;
        ++count;
    }
    /// Estimates the variance of a pixel's light from the added values. The estimate includes the
    /// pixel's own distance from the mean, because the pixel may hold a rare bright sample. With
    /// fewer than kSurely values, the square of the mean is added.
    [[nodiscard]] float varianceOf(const Eigen::Array3f& light) const {
        if (!(count > 0)) return 0;
        const float mean = sum / count, off = luminanceOf<float>(light.matrix()) - mean;
        const float spread = std::max(0.0F, squares / count - mean * mean) + off * off;
        return count < kSurely ? spread + mean * mean : spread;
    }
};

/// The third largest of the added values. With fewer than three values, it is infinite.
class ThirdLargest {
public:
    void add(float value) {
        ++count_;
        for (float& each : largest_)
            if (value > each) std::swap(value, each);
    }
    [[nodiscard]] float value() const {
        return count_ < largest_.size() ? std::numeric_limits<float>::infinity() : largest_.back();
    }

private:
    std::array<float, 3> largest_{};
    std::size_t count_ = 0;
};

// Limits the luminance to `most` if noise of this variance explains the excess.
void limit(Eigen::Array3f& light, float most, float variance) {
    const float y = luminanceOf<float>(light.matrix()), excess = y - most;
    if (excess > 0 && excess * excess <= kTolerance * kTolerance * variance) light *= most / y;
}

}  // namespace

void NoiseFilter::reserve(Size size) {
    const std::size_t count =
        static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
    const auto resize = [](auto& values, std::size_t wanted) {
        if (values.size() == wanted) return;
        values.reserve(wanted);
        preferLargePages(values.data(), wanted * sizeof(values[0]));
        values.resize(wanted);
    };
    resize(pixels_, count);
    resize(variances_, count);
    resize(limits_, count);
    stride_ = count + 2 * simd::kNoiseMargin;
    resize(values_, kArrays * stride_);
}

void NoiseFilter::begin(Size size, const PixelRect& where, double focal) {
    reserve(size);
    size_ = size;
    catcherSlope_ = kDepthSlope * static_cast<float>(std::max(1.0, kFineFocal / focal));
    where_ = common(where, {0, 0, size.width, size.height});
}

void NoiseFilter::run(int stage, int firstRow, int lastRow) {
    for (int y = std::max(firstRow, where_.y0); y < std::min(lastRow, where_.y1); ++y) {
        if (stage >= kBefore) {
            filterRow(stage - kBefore, y);
            continue;
        }
        for (int x = where_.x0; x < where_.x1; ++x)
            stage == 0 ? estimateNoise(x, y) : meanVariance(x, y);
    }
}

template <class Use>
void NoiseFilter::forNeighbours(int x, int y, int reach, int step, Use use) const {
    const LightPixel& centre = pixels_[static_cast<std::size_t>(y) * size_.width + x];
    const float slope = centre.id == kCatcherId ? catcherSlope_ : kDepthSlope;
    for (int dy = -reach; dy <= reach; ++dy) {
        const int v = y + dy * step;
        if (v < where_.y0 || v >= where_.y1) continue;
        for (int dx = -reach; dx <= reach; ++dx) {
            const int u = x + dx * step;
            if (u < where_.x0 || u >= where_.x1) continue;
            const std::size_t i = static_cast<std::size_t>(v) * size_.width + u;
            const LightPixel& there = pixels_[i];
            if (there.id != centre.id) continue;
            const auto away = static_cast<float>(step * std::max(std::abs(dx), std::abs(dy)));
            if (std::abs(there.depth - centre.depth) <= slope * away * centre.depth) use(i);
        }
    }
}

// A pixel of the shadow catcher gets no limits, because its light is the change caused by objects,
// which is negative in a shadow.
NoiseFilter::Limits NoiseFilter::limitsAt(int x, int y) const {
    const std::size_t i = static_cast<std::size_t>(y) * size_.width + x;
    const LightPixel& pixel = pixels_[i];
    if (pixel.id == 0 || pixel.id == kCatcherId || pixel.kept) return {};
    ThirdLargest first, second;
    forNeighbours(x, y, 1, 1, [&](std::size_t j) {
        if (j == i) return;
        const LightPixel& there = pixels_[j];
        if (there.firstCount > 0) first.add(luminanceOf<float>(there.first.matrix()));
        if (there.secondCount > 0) second.add(luminanceOf<float>(there.second.matrix()));
    });
    Limits out;
    if (pixel.firstCount > 0) out.first = first.value();
    if (pixel.secondCount > 0) out.second = second.value();
    return out;
}

void NoiseFilter::estimateNoise(int x, int y) {
    const std::size_t i = static_cast<std::size_t>(y) * size_.width + x;
    limits_[i] = limitsAt(x, y);
    const LightPixel& pixel = pixels_[i];
    variances_[i] = {pixel.firstVariance, pixel.secondVariance};
    if (pixel.id == 0 || (pixel.firstVariance >= 0 && pixel.secondVariance >= 0)) return;
    Spread first, second;
    forNeighbours(x, y, kSpreadReach, kSpreadStep, [&](std::size_t j) {
        first.add(pixels_[j].first, pixels_[j].firstCount);
        second.add(pixels_[j].second, pixels_[j].secondCount);
    });
    const auto found = [](const Spread& spread, const Eigen::Array3f& light, float count) {
        return count > 0 ? spread.varianceOf(light) : 0;
    };
    if (pixel.firstVariance < 0) variances_[i].first = found(first, pixel.first, pixel.firstCount);
    if (pixel.secondVariance < 0)
        variances_[i].second = found(second, pixel.second, pixel.secondCount);
}

NoiseFilter::Variances NoiseFilter::meanAround(int x, int y, int reach, int& known) const {
    Variances sum;
    int firsts = 0, seconds = 0;
    forNeighbours(x, y, reach, 1, [&](std::size_t j) {
        if (pixels_[j].firstCount > 0) {
            sum.first += variances_[j].first;
            ++firsts;
        }
        if (pixels_[j].secondCount > 0) {
            sum.second += variances_[j].second;
            ++seconds;
        }
    });
    known = std::min(firsts, seconds);
    return {sum.first / static_cast<float>(std::max(firsts, 1)),
            sum.second / static_cast<float>(std::max(seconds, 1))};
}

// A variance estimated from few samples is inaccurate, so the mean over neighbours is used. If only
// a few of the nine nearest pixels have samples, the mean over 25 pixels counts, too, if it is
// larger. Otherwise, pixels whose few samples agree by chance would count as exact, and shadows
// would have spots. (The mean over 25 pixels alone leaves bright grains.)
void NoiseFilter::meanVariance(int x, int y) {
    constexpr int kFewKnown = 4;
    const std::size_t i = static_cast<std::size_t>(y) * size_.width + x;
    LightPixel& pixel = pixels_[i];
    if (pixel.id != 0) {
        int known = 0;
        Variances mean = meanAround(x, y, 1, known);
        if (known <= kFewKnown) {
            const Variances wide = meanAround(x, y, 2, known);
            mean = {std::max(mean.first, wide.first), std::max(mean.second, wide.second)};
        }
        pixel.firstVariance = mean.first;
        pixel.secondVariance = mean.second;
        limit(pixel.first, limits_[i].first, variances_[i].first);
        limit(pixel.second, limits_[i].second, variances_[i].second);
    }
    pack(i);
}

void NoiseFilter::pack(std::size_t i) {
    const LightPixel& pixel = pixels_[i];
    const bool isEmpty = pixel.id == 0;
    const auto set = [&](int number, float value) { array(number)[i] = isEmpty ? 0 : value; };
    for (int c = 0; c < 3; ++c) {
        set(kFirst + c, pixel.first[c]);
        set(kSecond + c, pixel.second[c]);
        set(kNormal + c, pixel.normal[c]);
    }
    set(kFirstVariance, pixel.firstVariance);
    set(kSecondVariance, pixel.secondVariance);
    set(kFirstCount, pixel.firstCount);
    set(kSecondCount, pixel.secondCount);
    set(kDepth, pixel.depth);
    set(kId, pixel.id);
    set(kFixed, pixel.kept ? 1 : 0);
}

void NoiseFilter::unpack(std::size_t i, int set) {
    LightPixel& pixel = pixels_[i];
    if (pixel.id == 0) return;
    const auto get = [&](int number) { return array(set * kOfSet + number)[i]; };
    for (int c = 0; c < 3; ++c) {
        pixel.first[c] = get(kFirst + c);
        pixel.second[c] = get(kSecond + c);
    }
    pixel.firstVariance = get(kFirstVariance);
    pixel.secondVariance = get(kSecondVariance);
    pixel.firstCount = get(kFirstCount);
    pixel.secondCount = get(kSecondCount);
}

template <class Float>
std::array<simd::LightPart<Float>, 2> NoiseFilter::parts(int set) {
    const auto of = [&](int number) -> Float* { return array(set * kOfSet + number); };
    return {
        {{{of(kFirst), of(kFirst + 1), of(kFirst + 2)}, of(kFirstVariance), of(kFirstCount)},
         {{of(kSecond), of(kSecond + 1), of(kSecond + 2)}, of(kSecondVariance), of(kSecondCount)}}};
}

void NoiseFilter::filterRow(int level, int y) {
    const int step = 1 << level, from = level % 2, to = 1 - from;
    simd::filterNoiseRow({.surfaces = {{array(kNormal), array(kNormal + 1), array(kNormal + 2)},
                                       array(kDepth),
                                       array(kId),
                                       array(kFixed)},
                          .from = parts<const float>(from),
                          .to = parts<float>(to),
                          .where = where_,
                          .width = size_.width,
                          .y = y},
                         {.step = step,
                          .tolerance = kTolerance,
                          .catcherTolerance = kCatcherTolerance,
                          .catcherId = kCatcherId,
                          .leastVariance = kLeastVariance,
                          .depthSlope = kDepthSlope,
                          .catcherDepthSlope = catcherSlope_});
    if (level + 1 < kLevels) return;
    const std::size_t row = static_cast<std::size_t>(y) * size_.width;
    for (int x = where_.x0; x < where_.x1; ++x)
        unpack(row + static_cast<std::size_t>(x), to);
}

}  // namespace mfar
