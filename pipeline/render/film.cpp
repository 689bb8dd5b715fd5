#include "pipeline/render/film.h"

#include "base/luminance.h"
#include "pipeline/render/sampling_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

namespace mfar {
namespace {

using sampling::kTileEdge;

constexpr auto kRanks = [] {
    std::array<std::uint8_t, sampling::kTilePixels> out{};
    for (int y = 0; y < kTileEdge; ++y)
        for (int x = 0; x < kTileEdge; ++x)
            out[static_cast<std::size_t>(y) * kTileEdge + x] =
                static_cast<std::uint8_t>(sampling::rankOf(x, y));
    return out;
}();

constexpr float kGreyLevels = 255;
constexpr float kEnough = 16;  // with fewer samples, a pixel is always filtered
// Assumed contrast [grey levels] between an object and the unknown background: half the range.
constexpr float kEdgeContrast = 0.5F * kGreyLevels;

bool isLight(const Eigen::Vector3f& rgb) {
    return rgb.allFinite() && rgb.minCoeff() >= 0;
}

void keepNearest(FirstHit& kept, const FirstHit& hit) {
    if (kept.id == 0 || hit.depth < kept.depth) kept = hit;
}

double varianceOfMean(double sum, double squares, double n) {
    if (n < 2) return 0;
    return std::max(0.0, squares - sum * sum / n) / (n * (n - 1));
}

template <typename Number>
Number squared(Number value) {
    return value * value;
}

/// Returns the standard error of the luminance of `mean`, the mean of `count` samples. `square` is
/// the mean of their squared luminances. Returns 0 for fewer than two samples.
float deviationOf(const Eigen::Vector3f& mean, float square, float count) {
    if (count < 2) return 0;
    return std::sqrt(std::max(0.0F, square - squared(luminanceOf(mean))) / (count - 1));
}

float slopeAt(const Eigen::Vector3f& radiance, const Exposure& exposure) {
    return kGreyLevels * exposure.scale * srgbSlope(luminanceOf(radiance) * exposure.scale);
}

}  // namespace

std::shared_ptr<FilmMemory> Film::makeMemory() {
    return std::make_shared<FilmMemory>(kBlockPixels * sizeof(Pixel));
}

Film::Film(Size size, std::shared_ptr<FilmMemory> memory)
    : size_(size), tilesAcross_((static_cast<std::size_t>(size.width) + kTileEdge - 1) / kTileEdge),
      mutex_(std::make_unique<std::mutex>()), held_(std::move(memory)) {
    const std::size_t rows = (static_cast<std::size_t>(size.height) + kTileEdge - 1) / kTileEdge;
    static_assert(sampling::kTilePixels % kBlockPixels == 0);
    blockCount_ = rows * tilesAcross_ * (sampling::kTilePixels / kBlockPixels);
    blocks_ = std::make_unique<Block[]>(blockCount_);
}

void Film::begin() {
    ++picture_;
    held_.giveBack();
}

std::size_t Film::placeOf(std::size_t pixel) const {
    const auto width = static_cast<std::uint32_t>(size_.width);
    const std::uint32_t x = static_cast<std::uint32_t>(pixel) % width;
    const std::uint32_t y = static_cast<std::uint32_t>(pixel) / width;
    const std::size_t tile = y / kTileEdge * tilesAcross_ + x / kTileEdge;
    return tile * sampling::kTilePixels + kRanks[y % kTileEdge * kTileEdge + x % kTileEdge];
}

const Film::Pixel Film::kNothing{};

namespace {

const Eigen::Vector3f kNoFar{1, 1, 1};
constexpr double kTrustedCentre = 8, kManyHits = 16;

}  // namespace

Film::Pixel& Film::begun(std::size_t pixel) {
    const std::size_t place = placeOf(pixel);
    Block& block = blocks_[place / kBlockPixels];
    const std::size_t i = place % kBlockPixels;
    if (block.picture.load(std::memory_order_acquire) != picture_) addBlock(block);
    Pixel& p = block.pixels[i];
    if ((block.begun.load(std::memory_order_relaxed) >> i & 1U) == 0) {
        std::construct_at(&p);
        block.begun.fetch_or(1U << i, std::memory_order_relaxed);
    }
    return p;
}

// Several threads may find at the same time that a block has no memory for this picture yet. Only
// the first of these threads adds the memory.
void Film::addBlock(Block& block) {
    const std::scoped_lock lock(*mutex_);
    if (block.picture.load(std::memory_order_relaxed) == picture_) return;
    std::byte* memory = held_.memory->take();
    held_.blocks.push_back(memory);
    block.pixels = reinterpret_cast<Pixel*>(memory);
    block.begun.store(0, std::memory_order_relaxed);
    block.picture.store(picture_, std::memory_order_release);
}

std::uint64_t Film::dropped() const {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < blockCount_; ++i) {
        const Block& block = blocks_[i];
        if (block.picture.load(std::memory_order_acquire) != picture_) continue;
        for (std::size_t k = 0; k < kBlockPixels; ++k)
            if ((block.begun.load(std::memory_order_relaxed) >> k & 1U) != 0)
                sum += block.pixels[k].lost;
    }
    return sum;
}

void Film::setCentre(std::size_t pixel, const SeenSurface& surface) {
    Pixel& p = begun(pixel);
    p.seen = surface;
    p.isSeen = true;
}

bool Film::isUntouched(std::size_t pixel) const {
    const Pixel& p = at(pixel);
    return p.seen.hit.id == kCatcherId && isWhole(p) && !(p.catcher.first.squares > 0) &&
           !(p.carried.firstSquare > 0);
}

void Film::LightSum::add(double weight, const Eigen::Vector3f& sampled,
                         const Eigen::Vector3f& known) {
    light += weight * sampled.cast<double>();
    far += weight * known.cast<double>();
    weights += weight;
    squares += squared(luminanceOf<double>(sampled.cwiseQuotient(known).cast<double>()));
}

Eigen::Vector3f Film::LightSum::relative() const {
    if (!(weights > 0)) return {0, 0, 0};
    return light.cwiseQuotient(far).cast<float>();
}

void Film::add(std::size_t pixel, const FilmSample& sample) {
    Pixel& p = begun(pixel);
    ++p.taken;
    const bool isCatcher = sample.hit.id == kCatcherId;
    if (!isLight(sample.radiance) || !isLight(sample.without) || !isLight(sample.light.diffuse) ||
        !isLight(sample.light.specular)) {
        ++p.lost;
        return;
    }
    if (sample.hit.id == 0) return;
    keepNearest(isCatcher ? p.nearestCatcher : p.nearest, sample.hit);
    if (isCatcher) {
        ++p.catcher.hits;
        p.catcher.first.add(1, sample.radiance - sample.without, kNoFar);
        p.catcher.second.add(1, sample.without, kNoFar);
        return;
    }
    ++p.objectHits;
    p.radiance += sample.radiance.cast<double>();
    p.radianceSquares += squared(luminanceOf<double>(sample.radiance.cast<double>()));
    // At an edge, the sums below contain only samples of the object at the pixel's centre.
    // Otherwise, light of other objects would be shown on this object.
    if (hasObjectAtCentre(p) && sample.hit.id != p.seen.hit.id) return;
    ++p.object.hits;
    const auto [diffuse, specular] = weightsOf(sample.paint);
    p.object.first.add(diffuse, sample.light.diffuse, sample.far.diffuse);
    p.object.second.add(specular, sample.light.specular, sample.far.specular);
    p.diffusePaint += sample.paint.diffuse;
    p.facingPaint += sample.paint.facing;
    p.albedoScale += sample.paint.albedo.scale;
    p.albedoOffset += sample.paint.albedo.offset;
}

bool Film::isWhole(const Pixel& p) {
    const std::uint32_t n = p.taken - p.lost;
    if (p.seen.hit.id == 0) return n > 0 && (p.objectHits == n || p.catcher.hits == n);
    return (p.seen.hit.id == kCatcherId ? p.catcher : p.object).hits == n;
}

KnownLight Film::knownOf(const LightSums& sums, const KnownLight& carried) {
    const auto n = static_cast<float>(sums.hits);
    KnownLight out;
    out.firstCount = n + carried.firstCount;
    out.secondCount = n + carried.secondCount;
    if (out.firstCount > 0) {
        out.first =
            (n * sums.first.relative() + carried.firstCount * carried.first) / out.firstCount;
        out.firstSquare =
            (static_cast<float>(sums.first.squares) + carried.firstCount * carried.firstSquare) /
            out.firstCount;
    }
    if (out.secondCount > 0) {
        out.second =
            (n * sums.second.relative() + carried.secondCount * carried.second) / out.secondCount;
        out.secondSquare =
            (static_cast<float>(sums.second.squares) + carried.secondCount * carried.secondSquare) /
            out.secondCount;
    }
    return out;
}

KnownLight Film::known(std::size_t pixel) const {
    const Pixel& p = at(pixel);
    if (p.seen.hit.id == 0) return {};
    return knownOf(p.seen.hit.id == kCatcherId ? p.catcher : p.object, p.carried);
}

Paint Film::paintOf(const Pixel& p) {
    if (p.object.hits == 0) return p.seen.paint;
    const auto hits = static_cast<float>(p.object.hits);
    return {
        p.diffusePaint / hits, p.facingPaint / hits, {p.albedoScale / hits, p.albedoOffset / hits}};
}

SurfaceLight Film::farOf(const Pixel& p) {
    const auto mean = [&](const LightSum& sum, double weight, const Eigen::Vector3f& centre) {
        if (!p.isSeen) weight = 0;
        const double all = sum.weights + weight;
        return all > 0 ? Eigen::Vector3f(
                             ((sum.far + weight * centre.cast<double>()) / all).cast<float>())
                       : centre;
    };
    // The far light at the pixel's centre has no noise. So it counts as up to nine samples while
    // the pixel has few samples.
    const double fewer = std::max(0.0, 1 - p.object.hits / kManyHits);
    const double trust = 1 + kTrustedCentre * fewer;
    const auto [diffuse, specular] = weightsOf(p.seen.paint);
    return {mean(p.object.first, trust * diffuse, p.seen.far.diffuse),
            mean(p.object.second, trust * specular, p.seen.far.specular)};
}

float Film::error(std::size_t pixel, const Exposure& exposure) const {
    const Pixel& p = at(pixel);
    const auto n = static_cast<double>(p.taken - p.lost);
    const bool carries = p.carried.firstCount > 0 && isWhole(p);
    if (carries) return errorOfKnown(p, exposure);
    if (n < 2) return std::numeric_limits<float>::infinity();
    const auto objects = static_cast<double>(p.objectHits);
    const auto catchers = static_cast<double>(p.catcher.hits);
    double variance = 0;
    if (objects > 0) {
        const double slope = slopeAt((p.radiance / objects).cast<float>(), exposure) * objects / n;
        variance +=
            slope * slope * varianceOfMean(luminanceOf(p.radiance), p.radianceSquares, objects);
    }
    if (catchers > 0) {
        const double slope =
            slopeAt((p.catcher.second.light / catchers).cast<float>(), exposure) * catchers / n;
        variance +=
            slope * slope *
            varianceOfMean(luminanceOf(p.catcher.first.light), p.catcher.first.squares, catchers);
    }
    const double covered = objects / n;
    const double edge = kEdgeContrast * kEdgeContrast * covered * (1 - covered);
    return static_cast<float>(std::sqrt(variance + edge / (n * std::sqrt(n))));
}

// Diffuse and specular light of an object come from the same paths, so their errors are added.
float Film::errorOfKnown(const Pixel& p, const Exposure& exposure) {
    if (p.seen.hit.id == kCatcherId) {
        const KnownLight known = knownOf(p.catcher, p.carried);
        if (known.firstCount < 2) return std::numeric_limits<float>::infinity();
        return slopeAt(known.second, exposure) *
               deviationOf(known.first, known.firstSquare, known.firstCount);
    }
    const KnownLight known = knownOf(p.object, p.carried);
    if (known.firstCount < 2 || known.secondCount < 2)
        return std::numeric_limits<float>::infinity();
    const Paint paint = paintOf(p);
    const SurfaceLight far = farOf(p);
    const Eigen::Vector3f white = paint.diffuse.cwiseProduct(far.diffuse);
    const Eigen::Vector3f mirrored = paint.specular().cwiseProduct(far.specular);
    const float diffuse =
        luminanceOf(white) * deviationOf(known.first, known.firstSquare, known.firstCount);
    const float specular =
        luminanceOf(mirrored) * deviationOf(known.second, known.secondSquare, known.secondCount);
    const Eigen::Vector3f radiance =
        white.cwiseProduct(known.first) + mirrored.cwiseProduct(known.second);
    return slopeAt(radiance, exposure) * (diffuse + specular);
}

Film::Means Film::meansOf(const Pixel& p) {
    Means out;
    const auto n = static_cast<float>(p.taken - p.lost);
    if (p.objectHits > 0) {
        const double hits = p.objectHits;
        out.object = (p.radiance / hits).cast<float>();
        out.objectShare = static_cast<float>(hits) / n;
    }
    if (p.catcher.hits > 0) {
        const double hits = p.catcher.hits;
        out.with = ((p.catcher.first.light + p.catcher.second.light) / hits).cast<float>();
        out.without = (p.catcher.second.light / hits).cast<float>();
        out.catcherShare = static_cast<float>(hits) / n;
    }
    return out;
}

Film::Means Film::means(std::size_t pixel) const {
    return meansOf(at(pixel));
}

LightPixel Film::light(std::size_t pixel, const Exposure& exposure) const {
    // Noise up to this limit is invisible [grey levels].
    constexpr float kUnseen = 0.3F;
    const Pixel& p = at(pixel);
    LightPixel out;
    if (p.seen.hit.id == 0 && !isWhole(p)) return out;
    const FirstHit hit = p.seen.hit.id != 0 ? p.seen.hit
                         : p.objectHits > 0 ? p.nearest
                                            : p.nearestCatcher;
    if (hit.id == 0) return out;
    const bool isCatcher = hit.id == kCatcherId;
    const KnownLight known = knownOf(isCatcher ? p.catcher : p.object, p.carried);
    const auto varianceOf = [](const Eigen::Vector3f& mean, float square, float count) {
        return count < LightPixel::kFew ? -1 : squared(deviationOf(mean, square, count));
    };
    out.first = known.first.array();
    out.second = known.second.array();
    out.firstVariance = varianceOf(known.first, known.firstSquare, known.firstCount);
    out.secondVariance = varianceOf(known.second, known.secondSquare, known.secondCount);
    out.firstCount = known.firstCount;
    out.secondCount = known.secondCount;
    out.normal = p.seen.normal.array();
    out.depth = hit.depth;
    out.id = hit.id;
    out.kept = std::min(known.firstCount, known.secondCount) >= kEnough &&
               error(pixel, exposure) < kUnseen;
    return out;
}

}  // namespace mfar
