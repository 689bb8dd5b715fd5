#pragma once

#include "base/gl/gl.h"
#include "hal/gl_context.h"

#include <gtest/gtest.h>

#include <memory>

namespace mfar {

/// A test with a current GL context, shared by all tests of the program. Every test ends with a
/// look at the error state, so that no GL error goes unnoticed.
class GlTest : public testing::Test {
protected:
    static GlContext& context() {
        static const std::unique_ptr<GlContext> shared = createGlContext();
        return *shared;
    }
    void SetUp() override { context().makeCurrent(); }
    void TearDown() override { EXPECT_NO_THROW(gpu::checkErrors("the test's end")); }
};

}  // namespace mfar
