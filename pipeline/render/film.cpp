#include "pipeline/render/film.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mfar {
namespace {

constexpr float kDisplayGamma = 2.2F;
constexpr float kGreyLevels = 255;
// Of an unknown background to an object's value: half the range.
constexpr float kEdgeContrast = 0.5F * kGreyLevels;

template <typename Number>
Number luminanceOf(const Eigen::Vector3<Number>& rgb) {
    return rgb.dot(Eigen::Vector3d(0.2126, 0.7152, 0.0722).cast<Number>());
}

bool isLight(const Eigen::Vector3f& rgb) {
    return rgb.allFinite() && rgb.minCoeff() >= 0;
}

void keepNearest(FirstHit& kept, const FirstHit& hit) {
    if (kept.id == 0 || hit.depth < kept.depth) kept = hit;
}

/// Of the mean of n samples, from their sum and the sum of their squares.
double varianceOfMean(double sum, double squares, double n) {
    if (n < 2) return 0;
    return std::max(0.0, squares - sum * sum / n) / (n * (n - 1));
}

float slopeAt(const Eigen::Vector3f& radiance, const Exposure& exposure) {
    return kGreyLevels * exposure.scale * srgbSlope(luminanceOf(radiance) * exposure.scale);
}

std::uint8_t quantised(float value) {
    return static_cast<std::uint8_t>(std::lround(kGreyLevels * std::clamp(value, 0.0F, 1.0F)));
}

}  // namespace

Film::Film(Size size)
    : size_(size),
      pixels_(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height)) {}

const Film::Pixel Film::kNothing{};

Film::Pixel& Film::begun(std::size_t pixel) {
    Pixel& p = pixels_[pixel];
    if (p.picture != picture_) {
        p = {};
        p.picture = picture_;
    }
    return p;
}

std::uint64_t Film::dropped() const {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < pixels_.size(); ++i)
        sum += at(i).lost;
    return sum;
}

void Film::add(std::size_t pixel, const FilmSample& sample) {
    Pixel& p = begun(pixel);
    ++p.taken;
    if (!isLight(sample.radiance) || !isLight(sample.without)) {
        ++p.lost;
    } else if (sample.hit.id == kCatcherId) {
        ++p.catcherHits;
        p.with += sample.radiance.cast<double>();
        p.without += sample.without.cast<double>();
        const double change =
            luminanceOf<double>((sample.radiance - sample.without).cast<double>());
        p.changeSquares += change * change;
        keepNearest(p.catcher, sample.hit);
    } else if (sample.hit.id != 0) {
        ++p.objectHits;
        p.object += sample.radiance.cast<double>();
        p.baseColour += sample.baseColour;
        const double y = luminanceOf<double>(sample.radiance.cast<double>());
        p.objectSquares += y * y;
        keepNearest(p.nearest, sample.hit);
    }
}

void Film::setCentre(std::size_t pixel, const FirstHit& hit) {
    begun(pixel).centre = hit;
}

float Film::error(std::size_t pixel, const Exposure& exposure) const {
    const Pixel& p = at(pixel);
    const auto n = static_cast<double>(p.taken - p.lost);
    if (n < 2) return std::numeric_limits<float>::infinity();
    const auto objects = static_cast<double>(p.objectHits);
    const auto catchers = static_cast<double>(p.catcherHits);
    double variance = 0;
    if (objects > 0) {
        const double slope = slopeAt((p.object / objects).cast<float>(), exposure) * objects / n;
        variance += slope * slope * varianceOfMean(luminanceOf(p.object), p.objectSquares, objects);
    }
    if (catchers > 0) {
        const double slope = slopeAt((p.without / catchers).cast<float>(), exposure) * catchers / n;
        const double change = luminanceOf<double>(p.with - p.without);
        variance += slope * slope * varianceOfMean(change, p.changeSquares, catchers);
    }
    const double covered = objects / n;
    const double edge = kEdgeContrast * kEdgeContrast * covered * (1 - covered);
    return static_cast<float>(std::sqrt(variance + edge / (n * std::sqrt(n))));
}

Film::Means Film::meansOf(const Pixel& p) {
    Means out;
    const auto n = static_cast<float>(p.taken - p.lost);
    if (p.objectHits > 0) {
        const auto hits = static_cast<float>(p.objectHits);
        out.object = (p.object / double(p.objectHits)).cast<float>();
        out.objectShare = hits / n;
    }
    if (p.catcherHits > 0) {
        const auto hits = static_cast<float>(p.catcherHits);
        out.with = (p.with / double(p.catcherHits)).cast<float>();
        out.without = (p.without / double(p.catcherHits)).cast<float>();
        out.catcherShare = hits / n;
    }
    return out;
}

Film::Means Film::means(std::size_t pixel) const {
    return meansOf(at(pixel));
}

Film::Shown Film::shown(const Means& m, const Exposure& exposure) {
    Shown out{m.objectShare * displayed(m.object, exposure), m.objectShare};
    if (m.with == m.without) return out;
    const Eigen::Vector3f lit = displayed(m.with, exposure);
    const Eigen::Vector3f unlit = displayed(m.without, exposure);
    Eigen::Vector3f ratio{1, 1, 1};
    for (int c = 0; c < 3; ++c)
        if (m.without[c] > 0) ratio[c] = std::pow(m.with[c] / m.without[c], 1 / kDisplayGamma);
    const float kept = std::min(1.0F, ratio.minCoeff());
    for (int c = 0; c < 3; ++c) {
        const float added = unlit[c] > 0 ? unlit[c] * (ratio[c] - kept) : lit[c];
        out.colour[c] += m.catcherShare * std::min(added, 1.0F);
    }
    out.coverage += m.catcherShare * (1 - kept);
    return out;
}

FirstHit Film::firstHit(const Pixel& p, bool changed) {
    if (!changed) return {};
    const bool objects = p.objectHits > 0;
    if (p.centre.id != 0 && p.centre.id != kCatcherId) return p.centre;
    // The catcher is nothing where objects change nothing of it.
    if (p.catcherHits > 0 && !(p.with == p.without) && (p.centre.id == kCatcherId || !objects))
        return p.centre.id == kCatcherId ? p.centre : p.catcher;
    return objects ? p.nearest : FirstHit{};
}

Film::Shown Film::shown(const Pixel& p, const Exposure& exposure) {
    if (p.objectHits == 0 && p.with == p.without) return {};
    return shown(meansOf(p), exposure);
}

Film::Resolved Film::resolved(std::size_t pixel, const Exposure& exposure) const {
    const Pixel& p = at(pixel);
    return resolved(p, shown(p, exposure));
}

Film::Resolved Film::resolvedFrom(const NoisyPixel& filtered, std::size_t pixel) const {
    return resolved(at(pixel), Shown{filtered.value.head<3>().matrix(), filtered.value[3]});
}

Film::Resolved Film::resolved(const Pixel& p, const Shown& s) {
    Resolved out;
    out.colour = {quantised(s.colour.x()), quantised(s.colour.y()), quantised(s.colour.z()),
                  quantised(s.coverage)};
    out.hit = firstHit(p, out.colour != std::array<std::uint8_t, 4>{});
    return out;
}

// A pixel that only one surface is in; what others see of two is an edge.
NoisyPixel Film::noisy(std::size_t pixel, const Exposure& exposure) const {
    // Fewer samples say nothing of their spread.
    constexpr std::uint32_t kFew = 4;
    const Pixel& p = at(pixel);
    const Shown s = shown(p, exposure);
    NoisyPixel out;
    out.value << s.colour.array(), s.coverage;
    const std::uint32_t n = p.taken - p.lost;
    if (n == 0 || (p.objectHits != n && p.catcherHits != n)) return out;
    const FirstHit hit = p.objectHits == n ? firstHit(p, true) : p.catcher;
    const float error = this->error(pixel, exposure) / kGreyLevels;
    out.variance = n < kFew ? -1 : error * error;
    out.depth = hit.depth;
    out.id = hit.id;
    if (p.objectHits == n) out.baseColour = p.baseColour.array() / static_cast<float>(n);
    // A real surface without change stays without.
    out.kept = p.catcherHits == n && p.with == p.without;
    return out;
}

}  // namespace mfar
