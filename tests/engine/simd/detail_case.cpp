#include "tests/engine/simd/detail_case.h"

#include "pipeline/flow/cell_field.h"
#include "tests/oracle/superres.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mfar::simd {
namespace {

double pattern(double x, double y) {
    const double waves = std::sin(0.19 * x + 0.07 * y) + std::sin(0.11 * y - 0.05 * x) +
                         0.7 * std::sin(1.3 * x) * std::sin(1.1 * y);
    const double fine = std::sin(0.004 * x) > -0.3 ? 18 * std::sin(3.9 * x + 1.7 * y) : 0;
    const double edge = std::fmod(std::abs(x + 0.3 * y), 53) < 20 ? 40 : -20;
    return 120 + 25 * waves + fine + edge;
}

std::vector<std::uint8_t> shoot(Size size, double step, double footprint) {
    std::vector<std::uint8_t> out(4UL * size.width * size.height, 255);
    constexpr int kSamples = 3;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            std::array<double, 3> sums{};
            for (int i = 0; i < kSamples * kSamples; ++i) {
                const int column = i % kSamples, row = i / kSamples;
                const double dx = (column + 0.5) / kSamples - 0.5,
                             dy = (row + 0.5) / kSamples - 0.5;
                const double grey = pattern((x + 0.5) * step - 0.5 + dx * footprint,
                                            (y + 0.5) * step - 0.5 + dy * footprint);
                for (int c = 0; c < 3; ++c)
                    sums[c] += grey + 8 * c;
            }
            for (int c = 0; c < 3; ++c)
                out[4UL * (1UL * y * size.width + x) + c] = static_cast<std::uint8_t>(
                    std::clamp(sums[c] / (kSamples * kSamples), 0.0, 255.0));
        }
    return out;
}

TileWork workOf(Size tiles, double changedShare) {
    TileWork work;
    work.tiles = tiles;
    const int count = tiles.width * tiles.height;
    work.flags.resize(count);
    for (int i = 0; i < count; ++i) {
        // Changed tiles form clusters of a few tiles, as moving objects do.
        const int x = i % tiles.width / 3, y = i / tiles.width / 3;
        const unsigned mixed = (x * 73856093U) ^ (y * 19349663U);
        const bool changed = mixed % 1000 < changedShare * 1000;
        work.flags[i] = {static_cast<std::uint8_t>(changed), 1};
        work.changed += changed ? 1 : 0;
    }
    work.matched = work.changed;
    work.draw = changedShare < 1 ? TileWork::Draw::Tiles : TileWork::Draw::Whole;
    work.detailTiles = {0, 0, tiles.width, tiles.height};
    work.noise = 1;
    return work;
}

}  // namespace

StereoRig idealRig(Size video, Size still) {
    StereoRig rig;
    const double focal = 0.9 * video.width;
    rig.video = {video, focal, focal, (video.width - 1) / 2.0, (video.height - 1) / 2.0, {}};
    rig.still = rig.video.scaledTo(still);
    return rig;
}

DetailCase::DetailCase(Size videoSize, Size still, double changedShare)
    : rig(idealRig(videoSize, still)), videoPixels(shoot(videoSize, 1, 1)),
      stillPixels(shoot(still, static_cast<double>(videoSize.width) / still.width,
                        static_cast<double>(videoSize.width) / still.width)),
      video(videoSize), work(workOf(tilesOf(videoSize), changedShare)), cells(cellsOf(videoSize)) {
    video.take(videoView());
    const auto scale = static_cast<float>(rig.still.fx / rig.video.fx);
    for (int y = 0; y < cells.height; ++y)
        for (int x = 0; x < cells.width; ++x) {
            const auto px = static_cast<float>(x), py = static_cast<float>(y);
            const bool near = x > cells.width / 3 && x < cells.width / 2 && y > cells.height / 4;
            const float flowX = (near ? 9.0F : 3.0F) + 0.012F * px + std::sin(0.05F * py),
                        flowY = 1.5F - 0.02F * px + 0.004F * py;
            const bool flat = x < cells.width / 6;
            const float weight =
                flat ? 0 : std::clamp(0.7F + 0.5F * std::sin(0.3F * px + 0.2F * py), 0.0F, 1.15F);
            const float confidence = near ? 0.8F : 0.95F;
            weighed.push_back({flowX, flowY, weight, confidence});
            lookUps.push_back({scale * flowX, scale * flowY, weight, confidence});
            trust.push_back({0.5F * weight, confidence, flat ? 0.2F : 0.9F, flat ? 1.0F : 0.0F});
        }
    twin::Cells flow{cells, {}};
    for (const WeighedCell& cell : weighed)
        flow.values.insert(flow.values.end(), {cell.x, cell.y, 0, 0});
    for (int y = 0; y < cells.height; ++y)
        for (int x = 0; x < cells.width; ++x)
            lookUps[y * cells.width + x].confidenceAndJumps +=
                static_cast<float>(twin::jumpsAt(flow, x, y));
}

ImageView DetailCase::stillView(PixelFormat format) const {
    return {stillPixels.data(), rig.still.size, 4UL * rig.still.size.width, format};
}

ImageView DetailCase::videoView() const {
    return {videoPixels.data(), rig.video.size, 4UL * rig.video.size.width, PixelFormat::Rgba8};
}

DetailInput DetailCase::input(StillPreparation* still) const {
    return {video,
            work,
            still != nullptr ? still->pairs() : StillPairs{},
            still != nullptr ? still->picture() : Rows<const std::uint32_t>{},
            {weighed.data(), cells.width, cells},
            {lookUps.data(), cells.width, cells},
            {trust.data(), cells.width, cells}};
}

}  // namespace mfar::simd
