#pragma once

#include "base/gl/gl.h"
#include "hal/gl_context.h"

#include <gtest/gtest.h>

#include <memory>

namespace mfar {

/// The GL context that all tests of a program share. It is closed after the last test, because a
/// layer of the driver may already be destroyed while the process exits.
class SharedContext final : public testing::Environment {
public:
    GlContext& context() {
        if (!context_) context_ = createGlContext();
        return *context_;
    }
    void TearDown() override { context_.reset(); }

private:
    std::unique_ptr<GlContext> context_;
};

inline SharedContext* const kSharedContext = [] {
    auto* out = new SharedContext;
    testing::AddGlobalTestEnvironment(out);
    return out;
}();

/// Returns the factor by which the rounding error of a value in an 8-bit texture can exceed half a
/// grey level. GPUs may convert what a shader writes to a half float first. For values near 1, this
/// adds 2^-12, which is 0.06 grey levels, to half a grey level (seen on an NVIDIA H200).
inline double roundingFactor() {
    return kSharedContext->context().isSoftware() ? 1 : 1 + 2 * 255.0 / 4096;
}

/// A test in which the shared context is current.
class GlTest : public testing::Test {
protected:
    static GlContext& context() { return kSharedContext->context(); }
    void SetUp() override { context().makeCurrent(); }
    void TearDown() override { EXPECT_NO_THROW(gpu::checkErrors("the test's end")); }
};

}  // namespace mfar
