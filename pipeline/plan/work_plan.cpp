#include "pipeline/plan/work_plan.h"

#include "pipeline/plan/tiles.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mfar {
namespace {

constexpr double kInitialNoise = 0.29;
// Upper limit of the noise estimate [grey levels]. It is needed for pictures without any smooth
// tile, in which texture is measured as noise.
constexpr double kMaxNoise = 4.0;
// The whole frame is drawn at once if at least this share of the tiles changed, because drawing
// tile by tile takes 2.2 times as long per area (measured with llvmpipe).
constexpr double kWholeShare = 0.45;
// When a whole frame is enlarged, detail is drawn tile by tile if at most this share of the tiles
// in detailTiles has structure. Otherwise, detail is drawn in all tiles of detailTiles at once.
// Enlarging takes 0.4 times as long as drawing detail in all tiles at once.
constexpr double kListedShare = 0.27;
// Smallest structure of a matched tile, in units of the noise variance of a 2x2 mean. First term:
// noise alone gives 13, from 16 means minus three degrees of freedom of the plane. Second term: the
// weakest useful signal, whose detail gets a tenth of the full weight in superres_weigh.comp. The
// variance of this signal is 0.44 times the noise variance of a pixel, that is, 4 * 0.44 times the
// noise variance of a 2x2 mean. It is summed over 16 means.
constexpr double kStructure = 13 + 16 * 4 * 0.44;
constexpr double kRoundingVariance = 1.0 / 12;  // variance of 8-bit rounding [grey levels^2]
// In each frame, the grain estimate moves towards the measured value by a fraction of their
// difference. The fraction is kGrainFalls if the measured value is lower. If it is higher, the
// fraction is kGrainAtRest for a picture at rest and kGrainMoving for a moving picture.
constexpr double kGrainFalls = 0.2, kGrainAtRest = 0.05, kGrainMoving = 1.0 / 256;
// The picture counts as at rest if more than this share of the tiles is unchanged. Noise may mark
// some tiles as changed.
constexpr double kRestingShare = 0.75;
// Largest grain, see grain().
constexpr double kMaxGrain = 8;
// Larger measured values of the grain are reduced to this. The grain is a quotient of two
// variances, and in a picture without noise the divisor is almost 0.
constexpr double kMostRatio = 64;
constexpr int kNoiseBins = 64;  // number of bins of 1/16 grey level

}  // namespace

PixelRect tilesAround(const PixelRect& videoPixels) {
    const auto upwards = [](int pixel) { return (pixel + kTileSize - 1) / kTileSize; };
    return {videoPixels.x0 / kTileSize, videoPixels.y0 / kTileSize, upwards(videoPixels.x1),
            upwards(videoPixels.y1)};
}

WorkPlan::WorkPlan(Size video, std::shared_ptr<Workers> workers)
    : workers_(std::move(workers)), noise_(kInitialNoise), wholeShare_(kWholeShare),
      work_(TileWork::everything(tilesOf(video))) {}

void WorkPlan::drawnOver(const PixelRect& tiles, Redraw redraw) {
    drawnOver_ = {std::max(tiles.x0, 0), std::max(tiles.y0, 0),
                  std::min(tiles.x1, work_.tiles.width), std::min(tiles.y1, work_.tiles.height)};
    redraw_ = redraw;
}

void WorkPlan::update(const RgbPlanes& now, const RgbPlanes& drawn, bool force) {
    // Thresholds for noise of standard deviation s. The mean of 16 differences in a cell has a
    // standard deviation of 0.35 s. The mean of their absolute values is 1.13 s, with a standard
    // deviation of 0.21 s. Both thresholds are higher, because noise is stronger in bright regions,
    // and up to 1.5 times as strong in one colour channel as in luma.
    const double noise = noise_ * std::sqrt(grain_);
    measureTiles(now, drawn,
                 {static_cast<float>(1.0 + 2.0 * noise), static_cast<float>(1.5 + 4.0 * noise),
                  static_cast<float>(grain_)},
                 workers_.get(), measured_);
    const TileEnergy unchanged = markDrifted(measured_, work_.tiles.width, grain_);
    markBeside(measured_, work_.tiles.width);
    chooseMatched();
    chooseChanged(std::exchange(redraw_, Redraw::WithThem), force);
    followNoise(unchanged);
    work_.noise = noise_;
}

double WorkPlan::leastStructure() const {
    const double ofMean = grain_ * (noise_ * noise_ + kRoundingVariance) / 4;
    return kStructure * ofMean;
}

void WorkPlan::chooseMatched() {
    const bool everything = !(matchedShare_ > 0);
    const auto tiles = static_cast<double>(measured_.size());
    structured_.choose(measured_, work_.tiles.width, everything ? -1 : leastStructure(),
                       static_cast<int>(std::ceil(everything ? tiles : matchedShare_ * tiles)));
    work_.detailTiles = mayList() ? structured_.bounds(work_.tiles.width)
                                  : PixelRect{0, 0, work_.tiles.width, work_.tiles.height};
}

void WorkPlan::chooseChanged(Redraw redraw, bool force) {
    const auto isDrawnOver = [&](std::size_t tile, int margin) {
        const int x = static_cast<int>(tile) % work_.tiles.width,
                  y = static_cast<int>(tile) / work_.tiles.width;
        return x >= drawnOver_.x0 - margin && x < drawnOver_.x1 + margin &&
               y >= drawnOver_.y0 - margin && y < drawnOver_.y1 + margin;
    };
    const auto count = static_cast<int>(measured_.size());
    const int wholeFrom = std::max(1, static_cast<int>(std::ceil(wholeShare_ * count)));
    int changes = 0;
    bool beside = false;
    for (std::size_t i = 0; i < measured_.size(); ++i) {
        if (!measured_[i].changed) continue;
        ++changes;
        beside = beside || isDrawnOver(i, 1);
    }
    changedShare_ = static_cast<double>(changes) / std::max(count, 1);
    redraws_ = force || redraw == Redraw::Always || (redraw == Redraw::WithOthers && changes > 0) ||
               changes >= wholeFrom || beside;
    work_.changed = 0;
    work_.matched = 0;
    for (std::size_t i = 0; i < measured_.size(); ++i) {
        const bool changed = force || measured_[i].changed || (redraws_ && isDrawnOver(i, 0));
        work_.changed += changed ? 1 : 0;
        work_.matched += changed && structured_[i] ? 1 : 0;
        work_.flags[i] = {static_cast<std::uint8_t>(changed),
                          static_cast<std::uint8_t>(structured_[i])};
    }
    const auto inside = static_cast<double>(work_.detailTiles.area());
    const bool whole = work_.changed >= wholeFrom;
    const bool lists = whole && mayList() && structured_.count() <= kListedShare * inside;
    work_.draw = !whole  ? TileWork::Draw::Tiles
                 : lists ? TileWork::Draw::WholeEnlarged
                         : TileWork::Draw::Whole;
}

double WorkPlan::redrawnShare() const {
    if (work_.drawsWhole()) return 1;
    return static_cast<double>(work_.changed) / static_cast<double>(work_.flags.size());
}

double WorkPlan::structuredPerMatched() const {
    const int matched = structured_.count();
    return matched > 0 ? static_cast<double>(structured_.candidates()) / matched : 1;
}

double WorkPlan::quietestDecile() const {
    std::array<std::size_t, kNoiseBins> bins{};
    for (const TileMeasure& tile : measured_)
        ++bins[static_cast<std::size_t>(std::clamp(tile.noise * 16, 0.0F, kNoiseBins - 1.0F))];
    std::size_t below = 0, bin = 0;
    for (; bin < kNoiseBins - 1; ++bin) {
        below += bins[bin];
        if (10 * below >= measured_.size()) break;
    }
    return (static_cast<double>(bin) + 0.5) / 16;
}

void WorkPlan::followNoise(const TileEnergy& unchanged) {
    noise_ = std::min(0.8 * noise_ + 0.2 * quietestDecile(), kMaxNoise);
    if (unchanged.tiles == 0) return;
    const double now = std::min(unchanged.bends / std::max(unchanged.pixels, 1e-3), kMostRatio);
    // Moving structure looks like noise. So the estimate rises quickly only if the picture is at
    // rest.
    const bool atRest = unchanged.tiles > kRestingShare * static_cast<double>(measured_.size());
    const double risen = atRest ? kGrainAtRest : kGrainMoving;
    grain_ += (now - grain_) * (now < grain_ ? kGrainFalls : risen);
    grain_ = std::clamp(grain_, 1.0, kMaxGrain);
}

}  // namespace mfar
