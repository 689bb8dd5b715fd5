#include "pipeline/engine_guess.h"
#include "pipeline/engine_trial.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/pictures.h"

#include <algorithm>

namespace mfar {
namespace {

class EngineTrials : public GlTest {};

TEST_F(EngineTrials, EveryAssignmentOfStepsToEnginesIsMeasuredOnceAndTheFastestComesFirst) {
    const auto placements = promisingEngines("a GPU that no board has");
    const auto trials =
        tryEngines(placements, plainRig({160, 120}, {320, 240}), {320, 240}, EngineKind::Gles);
    ASSERT_EQ(trials.size(), placements.size());
    for (const EngineChoice& engines : placements)
        EXPECT_EQ(std::ranges::count(trials, engines, &EngineTrial::engines), 1);
    EXPECT_TRUE(std::ranges::is_sorted(trials, {}, &EngineTrial::frameMs));
    EXPECT_GT(trials.front().frameMs, 0);
}

TEST_F(EngineTrials, ThePathTracedLayerIsReducedToTheGpusLargestTexture) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    EXPECT_EQ(layerOnGpu({640, 480}), (Size{640, 480}));
    EXPECT_EQ(layerOnGpu({most / 2, most / 4}), (Size{most / 2, most / 4}));
    EXPECT_EQ(layerOnGpu({most, most / 4}), (Size{most / 2, most / 8}));
    EXPECT_EQ(layerOnGpu({most / 4, most / 2}), (Size{most / 8, most / 4}));
}

TEST_F(EngineTrials, PicturesBeyondTheGpusLargestTextureDoNotFit) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    EXPECT_TRUE(fitsGpu(plainRig({640, 480}, {2304, 1728}), {2304, 1728}));
    EXPECT_FALSE(fitsGpu(plainRig({640, most / 4 + 1}, {2304, 1728}), {2304, 1728}));
    EXPECT_FALSE(fitsGpu(plainRig({640, 480}, {2304, 1728}), {most + 1, 1728}));
}

}  // namespace
}  // namespace mfar
