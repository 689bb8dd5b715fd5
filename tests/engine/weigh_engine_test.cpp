#include "pipeline/gles/cell_weigher.h"
#include "pipeline/gles/flow2d.h"
#include "pipeline/plan/work_plan.h"
#include "pipeline/simd/weigh_step.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/pictures.h"

#include <cmath>
#include <span>

namespace mfar {
namespace {

using WeighEngines = GlTest;

Rows<const FlowCell> flowRows(const std::vector<FlowCell>& cells, const Flow2d::Field& field) {
    return {cells.data() + field.offset, field.cells.width, field.cells};
}

TEST_F(WeighEngines, BothEnginesGiveTheSameWeights) {
    constexpr Size kVideo{317, 235}, kStill{1141, 846};
    const StereoRig rig = bentRig(kVideo, kStill);
    const Waves waves(1, 6, 90, 40);
    const double step = static_cast<double>(kVideo.width) / kStill.width;
    WorkPlan plan(kVideo);
    TileBuffer tiles(kVideo);
    LumaPyramids pyramids(kVideo);
    Flow2d flow(kVideo);
    CellWeigher weigher(rig);
    TestPicture picture = waves.shoot(kVideo, {});
    addNoise(picture, 1.5, 1);
    plan.matchStructured(0.6);
    for (int i = 0; i < 20; ++i)  // after these frames the noise is known
        plan.update(planesOf(picture), planesOf(picture), true);
    const TileWork& work = plan.work();
    tiles.set(work);
    pyramids.buildVideo(uploaded(picture));
    const TestPicture still = waves.shoot(kStill, {.step = step, .footprint = step});
    pyramids.buildStill(uploaded(still, gpu::Filter::Linear), ToneTexture(), rig, 0);
    flow.run(pyramids.luma(), tiles, false);
    const Flow2d::Field &there = flow.forward(), &back = flow.backward();
    auto cells =
        flow.cells().read<FlowCell>(std::max(there.offset + there.cells.width * there.cells.height,
                                             back.offset + back.cells.width * back.cells.height));
    const Size size = there.cells;
    for (int y = size.height / 2; y < size.height; ++y)  // a surface in front of the other
        for (int x = size.width / 2; x < size.width; ++x)
            cells[static_cast<std::size_t>(there.offset) + y * size.width + x].x += 3;
    gpu::Buffer flowCells(cells.size() * sizeof(FlowCell));
    flowCells.write(std::span<const FlowCell>(cells));
    weigher.run({pyramids.video(), pyramids.still(), pyramids.words(), flowCells, there.offset,
                 size, back.cells, back.level, false},
                tiles);

    ASSERT_GT(work.matched, 0);
    ASSERT_LT(work.matched, work.changed);
    const LumaLevel& last = pyramids.still().back();
    const auto words = pyramids.words().read<std::uint32_t>(
        static_cast<std::size_t>(last.offset) + static_cast<std::size_t>(last.pitch) * last.height +
        kLumaSpareWords);
    simd::WeighStep weigh(rig, nullptr);
    weigh.run({pyramids.video(),
               pyramids.still(),
               words,
               flowRows(cells, there),
               flowRows(cells, back),
               back.level,
               {},
               work});

    const std::vector<float> wanted = weigher.weighed().readRgba32F(),
                             lookUps = weigher.lookUps().readRgba32F();
    double sum = 0;
    int jumps = 0;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const std::size_t at = 4UL * (static_cast<std::size_t>(y) * size.width + x);
            const float* w = &wanted[at];
            const LookUpCell& look = weigh.lookUps()[y][x];
            ASSERT_NEAR(look.confidenceAndJumps, lookUps[at + 3], 4e-3) << x << ", " << y;
            jumps += look.jumpsRight() + look.jumpsBelow();
            const WeighedCell& got = weigh.weighed()[y][x];
            ASSERT_EQ(got.x, w[0]);
            ASSERT_EQ(got.y, w[1]);
            ASSERT_NEAR(got.weight, w[2], std::min(got.weight, w[2]) > 0 ? 2e-3 : 5e-3)
                << x << ", " << y;
            ASSERT_NEAR(got.confidence, w[3], 1e-4) << x << ", " << y;
            sum += got.weight;
        }
    EXPECT_GT(sum, 100);
    EXPECT_GT(jumps, (size.width + size.height) / 2);
}

}  // namespace
}  // namespace mfar
