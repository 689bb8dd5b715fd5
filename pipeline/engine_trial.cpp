#include "pipeline/engine_trial.h"

#include "base/gl/texture.h"
#include "pipeline/engine/params/enlarge.h"
#include "pipeline/engine_guess.h"
#include "pipeline/warp/rerendered_pictures.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <utility>

namespace mfar {
namespace {

constexpr int kWarmUp = 2, kFrames = 5;  // numbers of unmeasured and of measured frames
constexpr int kShift = 3;                // motion of the generated video [px per frame]

/// Grey value of a texture of random squares in three sizes, so that every pyramid level has
/// structure.
std::uint8_t greyAt(int x, int y) {
    unsigned sum = 0;
    for (const int side : {2, 9, 40}) {
        auto hash = static_cast<std::uint32_t>(x / side) * 0x9E3779B1U ^
                    static_cast<std::uint32_t>(y / side) * 0x85EBCA77U;
        hash = (hash ^ (hash >> 15)) * 0x2C1B3C6DU;
        sum += (hash >> 24) / 3;
    }
    return static_cast<std::uint8_t>(sum);
}

/// Returns an RGBA picture of the texture. A pixel is `scale` texels wide, and the first pixel is
/// in column 1000 + `shift` and row 1000 [texels].
std::vector<std::uint8_t> pictureOf(Size size, double scale, int shift) {
    std::vector<std::uint8_t> rgba;
    rgba.reserve(4UL * size.width * size.height);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const std::uint8_t grey = greyAt(static_cast<int>(x * scale) + shift + 1000,
                                             static_cast<int>(y * scale) + 1000);
            rgba.insert(rgba.end(), {grey, grey, grey, 255});
        }
    return rgba;
}

ImageView viewOf(const std::vector<std::uint8_t>& rgba, Size size) {
    return {rgba.data(), size, 4UL * size.width, PixelFormat::Rgba8};
}

/// Returns the median time of a frame [ms]. If the first measured frame takes longer than `most`
/// [ms], nothing more is measured, and its time is returned.
double medianFrame(const EngineChoice& engines, const StereoRig& rig, Size output,
                   EngineKind shownFrom, double most) {
    using Clock = std::chrono::steady_clock;
    PipelineOptions options;
    options.output = output;
    options.engines = engines;
    Pipeline pipeline(rig, options);
    const double texels = static_cast<double>(rig.video.size.width) / rig.still.size.width;
    pipeline.setStill(viewOf(pictureOf(rig.still.size, texels, 0), rig.still.size), {});
    std::vector<double> ms;
    for (int i = 0; i < kWarmUp + kFrames; ++i) {
        const auto rgba = pictureOf(rig.video.size, 1, kShift * (1 + i));
        const auto begun = Clock::now();
        pipeline.run(viewOf(rgba, rig.video.size), Timestamp::fromSeconds(i / 30.0));
        pipeline.finish(shownFrom);
        if (i < kWarmUp) continue;
        ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begun).count());
        if (ms.front() > most) return ms.front();
    }
    std::ranges::nth_element(ms, ms.begin() + kFrames / 2);
    return ms[kFrames / 2];
}

}  // namespace

std::vector<EngineTrial> tryEngines(const std::vector<EngineChoice>& placements,
                                    const StereoRig& rig, Size output, EngineKind shownFrom) {
    std::vector<EngineTrial> trials;
    double most = std::numeric_limits<double>::infinity();
    for (const EngineChoice& engines : placements) {
        trials.push_back({engines, medianFrame(engines, rig, output, shownFrom, most)});
        most = std::min(most, kHopelessFrame * trials.back().frameMs);
    }
    std::ranges::sort(trials, {}, &EngineTrial::frameMs);
    return trials;
}

bool fitsGpu(const StereoRig& rig, Size output) {
    const int most = gpu::largestTexture();
    const auto [video, still] = std::pair(rig.video.size, rig.still.size);
    // The learned enlargement writes kGrid pictures of the video, one above the other.
    return std::max({video.width, params::kGrid * video.height, still.width, still.height,
                     output.width, output.height}) <= most;
}

Size layerOnGpu(Size wanted) {
    // The silhouette has twice the layer's width and height. The re-rendered pictures are one below
    // the other.
    const double most = gpu::largestTexture();
    const double share = std::min({1.0, most / (2.0 * wanted.width),
                                   most / (1.0 * RerenderedPictures::kPictures * wanted.height)});
    const auto scaled = [&](int edge) { return std::max(1, static_cast<int>(share * edge)); };
    return {scaled(wanted.width), scaled(wanted.height)};
}

}  // namespace mfar
