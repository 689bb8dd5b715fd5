#include "hal/picture.h"

#include <GLES3/gl31.h>

#include <cstring>
#include <stdexcept>

namespace mfar {
namespace {

void readBack(const GlImage& image, std::uint8_t* rgba, std::size_t stride) {
    GLint framebufferBefore = 0, packBefore = 0;
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &framebufferBefore);
    glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &packBefore);
    GLuint framebuffer = 0;
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, image.texture,
                           0);
    const bool complete = glCheckFramebufferStatus(GL_READ_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    if (complete) {
        glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
        glPixelStorei(GL_PACK_ROW_LENGTH, static_cast<GLint>(stride / 4));
        glReadPixels(0, 0, image.size.width, image.size.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
        glPixelStorei(GL_PACK_ROW_LENGTH, 0);
        glBindBuffer(GL_PIXEL_PACK_BUFFER, static_cast<GLuint>(packBefore));
    }
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(framebufferBefore));
    glDeleteFramebuffers(1, &framebuffer);
    if (!complete) throw std::runtime_error("the finished picture cannot be read back from GL");
}

}  // namespace

void copyPicture(const Picture& picture, std::uint8_t* rgba, std::size_t stride) {
    assert(stride % 4 == 0);
    if (!picture.isOnHost()) {
        readBack(picture.image(), rgba, stride);
        return;
    }
    const Rows<const std::uint32_t>& rows = picture.rows();
    for (int y = 0; y < rows.size.height; ++y)
        std::memcpy(rgba + static_cast<std::size_t>(y) * stride, rows[y],
                    static_cast<std::size_t>(rows.size.width) * 4);
}

}  // namespace mfar
