#include "pipeline/engine_guess.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace mfar {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Not;
using testing::SizeIs;

const EngineChoice kSimd = EngineChoice::all(EngineKind::Simd),
                   kGles = EngineChoice::all(EngineKind::Gles);

TEST(EngineGuess, OnAnUnknownGpuEveryAssignmentOfStepsToEnginesIsMeasured) {
    EXPECT_THAT(promisingEngines("EGL device, some GPU, OpenGL ES 3.2"), SizeIs(4));
    EXPECT_THAT(promisingEngines(""), SizeIs(4));
}

TEST(EngineGuess, IfShadersAreFarTooSlowOnlyTheSimdEngineIsMeasured) {
    EXPECT_THAT(promisingEngines("EGL device, hardware: V3D 4.2.14.0, OpenGL ES 3.1"),
                ElementsAre(kSimd));
}

TEST(EngineGuess, TheMostPromisingAssignmentOfStepsToEnginesComesFirst) {
    EngineChoice drawing = kGles;
    drawing.pyramid = drawing.flow = drawing.weigh = EngineKind::Simd;
    const auto guess = promisingEngines("Mali-G610 (Panfrost)");
    ASSERT_THAT(guess, SizeIs(3));
    EXPECT_EQ(guess.front(), drawing);
    EXPECT_THAT(guess, Contains(kSimd));
    EngineChoice matching = EngineChoice::all(EngineKind::Simd);
    matching.pyramid = matching.flow = matching.weigh = EngineKind::Gles;
    EXPECT_THAT(guess, Not(Contains(matching)));
}

}  // namespace
}  // namespace mfar
