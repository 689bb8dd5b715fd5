#include "base/gl/texture.h"
#include "tests/engine/gl_test.h"

namespace mfar {
namespace {

using gpu::TexelFormat;
using GlTexture = GlTest;

GLint bound(GLenum binding) {
    GLint out = -1;
    glGetIntegerv(binding, &out);
    return out;
}

// GL unbinds a texture or framebuffer when it is deleted.
TEST_F(GlTexture, ARefusedTextureIsDeleted) {
    constexpr int kTooManyLevels = 9;
    EXPECT_THROW(gpu::Texture({8, 8}, TexelFormat::Rgba8, gpu::Filter::Nearest, kTooManyLevels),
                 gpu::GlError);
    EXPECT_EQ(bound(GL_TEXTURE_BINDING_2D), 0);
}

TEST_F(GlTexture, ARefusedFramebufferIsDeleted) {
    const gpu::Texture depth({8, 8}, TexelFormat::Depth24);
    EXPECT_THROW(gpu::Framebuffer{depth}, gpu::GlError);
    EXPECT_EQ(bound(GL_FRAMEBUFFER_BINDING), 0);
}

}  // namespace
}  // namespace mfar
