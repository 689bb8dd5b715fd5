#include "base/gl/texture.h"

#include "base/gl/validation.h"

#include <array>
#include <cassert>
#include <limits>
#include <string>
#include <utility>

namespace mfar::gpu {

namespace {

/// Makes all texels of the bound texture NaN if they are half floats.
void fillWithNan(Size size, TexelFormat format) {
    GLenum layout = GL_RGBA;
    if (format == TexelFormat::R16F) layout = GL_RED;
    if (format == TexelFormat::Rg16F) layout = GL_RG;
    if (layout == GL_RGBA && format != TexelFormat::Rgba16F) return;
    const std::vector<float> texels(std::size_t{4} * size.width * size.height,
                                    std::numeric_limits<float>::quiet_NaN());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.width, size.height, layout, GL_FLOAT,
                    texels.data());
}

}  // namespace

int largestTexture() {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    return most;
}

// Delegates to the default constructor, so that the destructor deletes the texture after an error.
Texture::Texture(Size size, TexelFormat format, Filter filter, int levels) : Texture() {
    size_ = size;
    format_ = format;
    checkErrors("a call before Texture()");
    const int most = largestTexture();
    if (size.width > most || size.height > most)
        throw GlError("a picture of " + std::to_string(size.width) + "x" +
                      std::to_string(size.height) + " pixels exceeds this GPU's limit of " +
                      std::to_string(most) + "x" + std::to_string(most));
    glGenTextures(1, &id_);
    glBindTexture(GL_TEXTURE_2D, id_);
    glTexStorage2D(GL_TEXTURE_2D, levels, static_cast<GLenum>(format), size.width, size.height);
    const GLint mag = filter == Filter::Linear ? GL_LINEAR : GL_NEAREST;
    GLint min = mag;
    if (levels > 1) min = filter == Filter::Linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, min);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, mag);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    // R8 textures are sampled as grey, so that one shader serves grey and colour pictures.
    if (format == TexelFormat::R8) {
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_G, GL_RED);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_B, GL_RED);
    }
    if (Validation::active() != nullptr) fillWithNan(size, format);
    checkErrors("Texture");
}

Texture::Texture(Texture&& other) noexcept
    : id_(std::exchange(other.id_, 0)), size_(other.size_), format_(other.format_) {}

Texture& Texture::operator=(Texture&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(size_, other.size_);
    std::swap(format_, other.format_);
    return *this;
}

Texture::~Texture() {
    if (id_ != 0) glDeleteTextures(1, &id_);
}

void Texture::upload(const PlaneView& rows) {
    GLenum layout = GL_RGBA;
    GLint bytes = 4;
    if (format_ == TexelFormat::Rg8) {
        layout = GL_RG;
        bytes = 2;
    }
    if (format_ == TexelFormat::R8) {
        layout = GL_RED;
        bytes = 1;
    }
    assert(format_ == TexelFormat::Rgba8 || bytes < 4);
    glBindTexture(GL_TEXTURE_2D, id_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (rows.stride % static_cast<std::size_t>(bytes) != 0) {
        for (int y = 0; y < size_.height; ++y)
            glTexSubImage2D(GL_TEXTURE_2D, 0, 0, y, size_.width, 1, layout, GL_UNSIGNED_BYTE,
                            rows.data + static_cast<std::size_t>(y) * rows.stride);
        return;
    }
    glPixelStorei(GL_UNPACK_ROW_LENGTH, static_cast<GLint>(rows.stride) / bytes);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size_.width, size_.height, layout, GL_UNSIGNED_BYTE,
                    rows.data);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

void Texture::upload(std::span<const float> values, int firstRow) {
    assert(format_ == TexelFormat::R32F || format_ == TexelFormat::Rg32F ||
           format_ == TexelFormat::Rgba32F);
    GLenum layout = GL_RED;
    std::size_t row = size_.width;
    if (format_ == TexelFormat::Rg32F) {
        layout = GL_RG;
        row *= 2;
    }
    if (format_ == TexelFormat::Rgba32F) {
        layout = GL_RGBA;
        row *= 4;
    }
    const auto rows = static_cast<int>(values.size() / row);
    assert(values.size() % row == 0 && firstRow >= 0 && firstRow + rows <= size_.height);
    glBindTexture(GL_TEXTURE_2D, id_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, firstRow, size_.width, rows, layout, GL_FLOAT,
                    values.data());
}

void Texture::uploadRows(std::span<const std::array<std::uint8_t, 4>> texels, int firstRow) {
    const std::size_t row = size_.width;
    const auto rows = static_cast<int>(texels.size() / row);
    assert(format_ == TexelFormat::Rgba8);
    assert(texels.size() % row == 0 && firstRow >= 0 && firstRow + rows <= size_.height);
    glBindTexture(GL_TEXTURE_2D, id_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, firstRow, size_.width, rows, GL_RGBA, GL_UNSIGNED_BYTE,
                    texels.data());
}

void Texture::upload(std::span<const std::uint32_t> values, int firstRow) {
    GLenum layout = GL_RED_INTEGER, type = GL_UNSIGNED_INT;
    std::size_t row = size_.width;
    if (format_ == TexelFormat::Rg32Ui) {
        layout = GL_RG_INTEGER;
        row *= 2;
    } else if (format_ == TexelFormat::Rgba32Ui) {
        layout = GL_RGBA_INTEGER;
        row *= 4;
    } else if (format_ == TexelFormat::Rgb9E5) {
        layout = GL_RGB;
        type = GL_UNSIGNED_INT_5_9_9_9_REV;
    } else {
        assert(format_ == TexelFormat::R32Ui);
    }
    const auto rows = static_cast<int>(values.size() / row);
    assert(values.size() % row == 0 && firstRow >= 0 && firstRow + rows <= size_.height);
    glBindTexture(GL_TEXTURE_2D, id_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, firstRow, size_.width, rows, layout, type, values.data());
}

void Texture::uploadLevel(int level, Size size,
                          std::span<const std::array<std::uint8_t, 4>> texels) {
    assert(format_ == TexelFormat::Srgb8Alpha8);
    assert(texels.size() == static_cast<std::size_t>(size.width) * size.height);
    glBindTexture(GL_TEXTURE_2D, id_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexSubImage2D(GL_TEXTURE_2D, level, 0, 0, size.width, size.height, GL_RGBA, GL_UNSIGNED_BYTE,
                    texels.data());
}

void Texture::repeat() const {
    glBindTexture(GL_TEXTURE_2D, id_);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTexParameteri(GL_TEXTURE_2D, axis, GL_REPEAT);
}

std::vector<std::uint8_t> Texture::readRgba8() const {
    std::vector<std::uint8_t> out(static_cast<std::size_t>(size_.width) * size_.height * 4);
    Framebuffer target(*this);
    target.bind();
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, size_.width, size_.height, GL_RGBA, GL_UNSIGNED_BYTE, out.data());
    checkErrors("Texture::readRgba8");
    return out;
}

std::vector<float> Texture::readRgba32F() const {
    std::vector<float> out(static_cast<std::size_t>(size_.width) * size_.height * 4);
    Framebuffer target(*this);
    target.bind();
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, size_.width, size_.height, GL_RGBA, GL_FLOAT, out.data());
    checkErrors("Texture::readRgba32F");
    return out;
}

// Delegates for the same reason as Texture().
Framebuffer::Framebuffer(std::span<const Texture* const> colour, const Texture* depth)
    : Framebuffer() {
    checkErrors("a call before Framebuffer()");
    glGenFramebuffers(1, &id_);
    glBindFramebuffer(GL_FRAMEBUFFER, id_);
    std::array<GLenum, 4> buffers{};
    assert(colour.size() <= buffers.size());
    for (std::size_t i = 0; i < colour.size(); ++i) {
        buffers[i] = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
        glFramebufferTexture2D(GL_FRAMEBUFFER, buffers[i], GL_TEXTURE_2D, colour[i]->id(), 0);
        size_ = colour[i]->size();
    }
    if (depth != nullptr) {
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth->id(), 0);
        size_ = depth->size();
    }
    glDrawBuffers(static_cast<GLsizei>(colour.size()), buffers.data());
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw GlError("the framebuffer is incomplete: this GPU cannot draw into the format of one "
                      "of its textures");
    checkErrors("Framebuffer");
}

Framebuffer::Framebuffer(const Texture& colour)
    : Framebuffer(std::array<const Texture*, 1>{&colour}) {}

Framebuffer::Framebuffer(Framebuffer&& other) noexcept
    : id_(std::exchange(other.id_, 0)), size_(other.size_) {}

Framebuffer& Framebuffer::operator=(Framebuffer&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(size_, other.size_);
    return *this;
}

Framebuffer::~Framebuffer() {
    if (id_ != 0) glDeleteFramebuffers(1, &id_);
}

void Framebuffer::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, id_);
    glViewport(0, 0, size_.width, size_.height);
}

}  // namespace mfar::gpu
