// Times the CPU's pyramids and 2-D flow. Each time is the minimum of many runs.

#include "pipeline/flow/cell_field.h"
#include "pipeline/simd/flow2d.h"
#include "pipeline/simd/luma_pyramids.h"
#include "tests/engine/simd/flow_pictures.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>

namespace mfar::simd {
namespace {

double leastMs(int runs, const std::function<void()>& body) {
    double least = 1e9;
    for (int i = 0; i < runs; ++i) {
        const auto begin = std::chrono::steady_clock::now();
        body();
        const std::chrono::duration<double, std::milli> taken =
            std::chrono::steady_clock::now() - begin;
        least = std::min(least, taken.count());
    }
    return least;
}

constexpr Size kVideo{640, 480}, kStill{2304, 1728};

void row(const char* what, double ms) {
    std::printf("  %-28s %7.3f ms\n", what, ms);
}

void measureRefine(Flow2d& flow, LumaPyramids& pyramids, const TileWork& work, int runs) {
    const Flow2d::Luma luma{pyramids.video(), pyramids.still(), pyramids.words()};
    const Size cells = cellsOf(kVideo);
    const std::size_t count = static_cast<std::size_t>(cells.width) * cells.height;
    const std::vector<std::array<float, 4>> errors(count);
    for (const double stretch : {1.0, 1.02, 1.12}) {
        const FlowPicture bent = wavesMoved(kVideo, {6.3, -2.4}, 1, 0, 1, stretch);
        pyramids.buildSecond(bent.rows());
        std::vector<std::array<float, 4>> seed(count);
        for (std::size_t i = 0; i < count; ++i) {
            const double x = 4 * static_cast<double>(i % 160) + 1.5;
            seed[i] = {static_cast<float>(x * (stretch - 1) + 6.1), -2.3F, 0, 0};
        }
        char what[32];
        std::snprintf(what, sizeof what, "refine, flow stretched by %.2f", stretch);
        row(what, leastMs(runs, [&] { flow.refine(luma, work, seed, errors, false); }));
        std::printf("  searched tiles: %d\n", flow.searchedCount());
    }
}

void measure(int threads, int runs) {
    const auto workers = std::make_shared<Workers>(threads);
    const FlowPicture first = wavesMoved(kVideo, {0, 0}), second = wavesMoved(kVideo, {6.3, -2.4});
    const FlowPicture still = wavesMoved(kStill, {0, 0});
    const RgbPlanes planes = planesOf(first);
    LumaPyramids pyramids(kVideo, workers);
    std::printf("%d threads\n", threads);
    row("video pyramid", leastMs(runs, [&] { pyramids.buildVideo(planes); }));
    const StereoRig rig = rigOf(kVideo, kStill);
    for (const float light : {0.0F, 1.0F})
        row(light > 0 ? "still pyramid, means of light" : "still pyramid",
            leastMs(std::max(1, runs / 10),
                    [&] { pyramids.buildStill(still.rows(), rig, light); }));
    pyramids.buildSecond(second.rows());
    const TileWork work = wholeWork(kVideo);
    Flow2d flow(kVideo, {}, workers);
    const Flow2d::Luma luma{pyramids.video(), pyramids.still(), pyramids.words()};
    row("flow, first frame", leastMs(runs, [&] { flow.run(luma, work, false); }));
    row("flow, later frame", leastMs(runs, [&] { flow.run(luma, work, true); }));
    TileWork few = work;
    few.draw = TileWork::Draw::Tiles;
    for (auto& tile : few.flags)
        tile.changed = 0;
    for (int i = 0; i < 30; ++i)
        few.flags[static_cast<std::size_t>(600 + i % 5 + i / 5 * few.tiles.width)].changed = 1;
    row("flow, 30 tiles of 1200", leastMs(runs, [&] { flow.run(luma, few, true); }));
    measureRefine(flow, pyramids, work, runs);
}

}  // namespace
}  // namespace mfar::simd

int main(int argc, char** argv) {
    const int runs = argc > 1 ? std::atoi(argv[1]) : 200;
    if (runs < 1) {
        std::fprintf(stderr, "usage: mfar-simd-flow-bench [RUNS]; RUNS must be at least 1\n");
        return 2;
    }
    for (const int threads : {1, 2})
        mfar::simd::measure(threads, runs);
}
