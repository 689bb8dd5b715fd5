#include "pipeline/engine_guess.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace mfar {
namespace {

using testing::ElementsAre;
using testing::Ge;
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
    ASSERT_THAT(guess, SizeIs(Ge(2U)));
    EXPECT_EQ(guess[0], drawing);
    EXPECT_EQ(guess[1], kSimd);
}

}  // namespace
}  // namespace mfar
