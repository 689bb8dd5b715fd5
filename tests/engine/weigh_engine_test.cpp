#include "pipeline/gles/cell_weigher.h"
#include "pipeline/gles/flow2d.h"
#include "pipeline/plan/work_plan.h"
#include "pipeline/simd/weigh_step.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/pictures.h"

#include <cmath>

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
    weigher.run({pyramids.video(), pyramids.still(), pyramids.words(), flow.cells(),
                 flow.forward().offset, flow.forward().cells, flow.backward().cells,
                 flow.backward().level, false},
                tiles);

    ASSERT_GT(work.matched, 0);
    ASSERT_LT(work.matched, work.changed);
    const LumaLevel& last = pyramids.still().back();
    const auto words = pyramids.words().read<std::uint32_t>(
        static_cast<std::size_t>(last.offset) + static_cast<std::size_t>(last.pitch) * last.height +
        kLumaSpareWords);
    const Flow2d::Field &there = flow.forward(), &back = flow.backward();
    const auto cells =
        flow.cells().read<FlowCell>(std::max(there.offset + there.cells.width * there.cells.height,
                                             back.offset + back.cells.width * back.cells.height));
    simd::WeighStep weigh(rig, nullptr);
    weigh.run({pyramids.video(),
               pyramids.still(),
               words,
               flowRows(cells, there),
               flowRows(cells, back),
               back.level,
               {},
               work});

    const std::vector<float> wanted = weigher.weighed().readRgba32F();
    double sum = 0;
    for (int y = 0; y < there.cells.height; ++y)
        for (int x = 0; x < there.cells.width; ++x) {
            const float* w = &wanted[4UL * (static_cast<std::size_t>(y) * there.cells.width + x)];
            const WeighedCell& got = weigh.weighed()[y][x];
            ASSERT_EQ(got.x, w[0]);
            ASSERT_EQ(got.y, w[1]);
            ASSERT_NEAR(got.weight, w[2], std::min(got.weight, w[2]) > 0 ? 2e-3 : 5e-3)
                << x << ", " << y;
            ASSERT_NEAR(got.confidence, w[3], 1e-4) << x << ", " << y;
            sum += got.weight;
        }
    EXPECT_GT(sum, 100);
}

}  // namespace
}  // namespace mfar
