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

}  // namespace
}  // namespace mfar
