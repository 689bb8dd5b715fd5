#include "pipeline/work_plan.h"

#include "pipeline/results.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mfar {
namespace {

constexpr double kInitialNoise = 0.29;
// A picture without any smooth tile looks noisy: the most that is believed.
constexpr double kMaxNoise = 4.0;
// Drawing by tiles costs 2.2 times as much an area as one full-screen draw (llvmpipe).
constexpr double kWholeShare = 0.45;
// Detail likewise, where all else is enlarged at once, which costs 0.4 times as much.
constexpr double kListedShare = 0.27;
// What structure adds up to, in the variance of a mean: 13 by noise alone (16 means less the
// plane's three), the rest by what gives detail a tenth of its weight in superres_weigh.comp (a
// signal of 0.44 of the noise; 16 / 4 as much in the variance of a mean).
constexpr double kStructure = 13 + 16 * 4 * 0.44;
constexpr double kRoundingVariance = 1.0 / 12;  // of a pixel [grey levels^2]
constexpr std::size_t kGrain = 32;              // bytes before it in the plan
// How fast the grain of the noise follows what a frame shows, by frame.
constexpr double kGrainFalls = 0.2, kGrainAtRest = 0.05, kGrainMoving = 1.0 / 256;
constexpr double kRestingShare = 0.75;  // of the tiles: the others may be misjudged
constexpr double kMaxGrain = 8;

}  // namespace

PixelRect tilesAround(const PixelRect& videoPixels) {
    const auto upwards = [](int pixel) { return (pixel + kTileSize - 1) / kTileSize; };
    return {videoPixels.x0 / kTileSize, videoPixels.y0 / kTileSize, upwards(videoPixels.x1),
            upwards(videoPixels.y1)};
}

WorkPlan::WorkPlan(Size video)
    : video_(video), tileCount_{(video.width + kTileSize - 1) / kTileSize,
                                (video.height + kTileSize - 1) / kTileSize},
      noise_(kInitialNoise), wholeShare_(kWholeShare),
      tiles_(sizeof(std::uint32_t) * 2 * (1 + tileCount_.width * tileCount_.height)),
      measuredTiles_(sizeof(float) * 8 * tileCount_.width * tileCount_.height),
      change_("plan_change.comp"), dispatch_("plan_dispatch.comp") {}

WorkPlan::Dispatch WorkPlan::add(gpu::Groups groups, For what) {
    wanted_.push_back({groups.x, groups.y, groups.z, what == For::Matched ? 1U : 0U});
    return {static_cast<int>(wanted_.size()) - 1};
}

void WorkPlan::upload() {
    const std::size_t bytes = wanted_.size() * sizeof(wanted_.front());
    wantedBuffer_ = gpu::Buffer(bytes);
    wantedBuffer_.write(std::span<const std::array<std::uint32_t, 4>>(wanted_));
    plan_ = gpu::Buffer(kPlanHeader + bytes);
}

void WorkPlan::openAll() {
    if (plan_.bytes() == 0) upload();
    plan_.write(std::span<const std::array<std::uint32_t, 4>>(wanted_), kPlanHeader);
    const std::vector<std::uint32_t> all(tiles_.bytes() / sizeof(std::uint32_t), 1);
    tiles_.write(std::span<const std::uint32_t>(all));
}

void WorkPlan::drawnOver(const PixelRect& tiles, Redraw redraw) {
    drawnOver_ = {std::max(tiles.x0, 0), std::max(tiles.y0, 0),
                  std::min(tiles.x1, tileCount_.width), std::min(tiles.y1, tileCount_.height)};
    redraw_ = redraw;
}

int WorkPlan::changedTiles() const {
    return static_cast<int>(plan_.read<std::uint32_t>(1)[0]);
}

bool WorkPlan::redraws() const {
    return plan_.read<std::uint32_t>(4)[3] != 0;
}

int WorkPlan::matchedTiles() const {
    return static_cast<int>(plan_.read<std::uint32_t>(3, kGrain)[2]);
}

void WorkPlan::followNoise() {
    if (!std::exchange(measured_, true)) return;
    const auto summary = plan_.read<std::uint32_t>(4);
    noise_ = std::min(0.8 * noise_ + 0.2 * summary[1] / 256.0, kMaxNoise);
    const auto grain = plan_.read<std::uint32_t>(4, kGrain);
    if (grain[1] == 0) return;
    // What moves has structure, too: more is believed slowly, but where all is at rest.
    const bool atRest = grain[1] > kRestingShare * tileCount_.width * tileCount_.height;
    const double now = grain[0] / 1024.0, risen = atRest ? kGrainAtRest : kGrainMoving;
    grain_ += (now - grain_) * (now < grain_ ? kGrainFalls : risen);
    grain_ = std::clamp(grain_, 1.0, kMaxGrain);
}

void WorkPlan::update(const gpu::Texture& now, const gpu::Texture& drawn, bool force) {
    if (plan_.bytes() == 0) upload();
    followNoise();
    // A cell's mean of 16 differences has a deviation of 0.35 s, its mean absolute difference 0.21
    // s around 1.13 s; both bounds leave room for brighter, noisier regions and for single colours,
    // whose noise is up to 1.5 times the luma's.
    const double noise = noise_ * std::sqrt(grain_);
    ChangeParams params{};
    params.size[0] = video_.width;
    params.size[1] = video_.height;
    params.size[2] = tileCount_.width;
    params.size[3] = tileCount_.height;
    params.threshold[0] = static_cast<float>(1.0 + 2.0 * noise);
    params.threshold[1] = static_cast<float>(1.5 + 4.0 * noise);
    params.threshold[2] = static_cast<float>(grain_);
    change_.run(params,
                {gpu::sampler(0, now), gpu::sampler(1, drawn), gpu::storage(0, measuredTiles_)},
                {static_cast<GLuint>(tileCount_.width), static_cast<GLuint>(tileCount_.height), 1});
    dispatch_.run(dispatchParams(force),
                  {gpu::storage(0, tiles_), gpu::storage(1, wantedBuffer_), gpu::storage(2, plan_),
                   gpu::storage(3, measuredTiles_)},
                  {});
}

WorkPlan::DispatchParams WorkPlan::dispatchParams(bool force) {
    DispatchParams p{};
    p.counts[0] = tileCount_.width * tileCount_.height;
    p.counts[1] = static_cast<std::int32_t>(wanted_.size());
    p.counts[2] = std::max(1, static_cast<std::int32_t>(std::ceil(wholeShare_ * p.counts[0])));
    p.counts[3] = tileCount_.width;
    p.drawnOver[0] = drawnOver_.x0;
    p.drawnOver[1] = drawnOver_.y0;
    p.drawnOver[2] = drawnOver_.x1;
    p.drawnOver[3] = drawnOver_.y1;
    p.redraw[0] = static_cast<std::int32_t>(std::exchange(redraw_, Redraw::WithThem));
    p.redraw[1] = force ? 1 : 0;
    const double ofMean = grain_ * (noise_ * noise_ + kRoundingVariance) / 4;
    const bool everything = !(matchedShare_ > 0);
    p.noise[0] = static_cast<float>(grain_);
    p.noise[1] = everything ? -1.0F : static_cast<float>(kStructure * ofMean);
    p.matched[0] =
        everything ? p.counts[0] : static_cast<int>(std::ceil(matchedShare_ * p.counts[0]));
    // Where nothing is drawn by tiles, detail is not, either.
    p.matched[1] =
        everything || !(wholeShare_ > 0) ? -1 : static_cast<int>(kListedShare * p.counts[0]);
    return p;
}

}  // namespace mfar
