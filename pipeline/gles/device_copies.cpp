#include "pipeline/gles/device_copies.h"

#include "base/gl/gl.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace mfar {
namespace {

struct Layout {
    GLenum channels, type;
    int bytes;
};

Layout layoutOf(gpu::TexelFormat format) {
    switch (format) {
    case gpu::TexelFormat::R8: return {GL_RED, GL_UNSIGNED_BYTE, 1};
    case gpu::TexelFormat::Rg8: return {GL_RG, GL_UNSIGNED_BYTE, 2};
    case gpu::TexelFormat::Rgba8: return {GL_RGBA, GL_UNSIGNED_BYTE, 4};
    case gpu::TexelFormat::R32F: return {GL_RED, GL_FLOAT, 4};
    default: return {GL_RGBA, GL_FLOAT, 16};
    }
}

std::uint8_t byteOf(float share) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0F, 1.0F)));
}

/// True if glReadPixels() can read the bound framebuffer in this layout. Every driver can read four
/// channels. Some can also read as many channels as the framebuffer has.
bool canRead(const Layout& layout) {
    if (layout.channels == GL_RGBA) return true;
    GLint channels = 0, type = 0;
    glGetIntegerv(GL_IMPLEMENTATION_COLOR_READ_FORMAT, &channels);
    glGetIntegerv(GL_IMPLEMENTATION_COLOR_READ_TYPE, &type);
    return static_cast<GLenum>(channels) == layout.channels &&
           static_cast<GLenum>(type) == layout.type;
}

/// Reads the pixels of `part` with four channels of T, a few rows at a time, and calls
/// take(texels, count, row) for each row. `first`: address of the part's first pixel in CPU memory.
/// The rows there begin `pitch` bytes after each other.
template <class T, class Take>
void readFourChannels(const PixelRect& part, GLenum type, std::byte* first, std::ptrdiff_t pitch,
                      const Take& take) {
    constexpr int kRowsTogether = 16;
    const int width = part.x1 - part.x0;
    std::vector<T> texels(static_cast<std::size_t>(4) * width * kRowsTogether);
    for (int y = part.y0; y < part.y1; y += kRowsTogether) {
        const int rows = std::min(kRowsTogether, part.y1 - y);
        glReadPixels(part.x0, y, width, rows, GL_RGBA, type, texels.data());
        gpu::checkErrors("TextureCopy");
        for (int i = 0; i < rows; ++i)
            take(texels.data() + static_cast<std::ptrdiff_t>(4) * width * i, width,
                 first + (y - part.y0 + i) * pitch);
    }
}

/// Takes the first `channels` of four channels.
template <class T>
auto takeFirstChannels(int channels) {
    return [channels](const T* texels, int count, std::byte* row) {
        for (T* to = reinterpret_cast<T*>(row); count-- > 0; texels += 4, to += channels)
            std::copy_n(texels, channels, to);
    };
}

void takeShares(const std::uint8_t* texels, int count, std::byte* row) {
    std::transform(texels, texels + std::ptrdiff_t{4} * count, reinterpret_cast<float*>(row),
                   [](std::uint8_t v) { return static_cast<float>(v) / 255; });
}

}  // namespace

void BufferCopy::upload(const void* data, std::ptrdiff_t) {
    const std::span bytes(static_cast<const std::byte*>(data), count_ * entryBytes_);
    assert(own_);
    own_->write(bytes);
}

std::size_t BufferCopy::download(void* data, std::ptrdiff_t) {
    const auto bytes = buffer_->read<std::byte>(count_ * entryBytes_,
                                                static_cast<std::size_t>(first_) * entryBytes_);
    std::ranges::copy(bytes, static_cast<std::byte*>(data));
    return bytes.size();
}

const gpu::Framebuffer& TextureCopy::target() {
    if (!target_) target_.emplace(*texture_);
    return *target_;
}

void TextureCopy::upload(const void* data, std::ptrdiff_t pitch) {
    const auto [width, height] = texture_->size();
    const Layout layout = layoutOf(texture_->format());
    std::vector<std::uint8_t> converted;
    if (floats_) {
        converted.reserve(static_cast<std::size_t>(4) * width * height);
        for (int y = 0; y < height; ++y) {
            const auto* row =
                reinterpret_cast<const float*>(static_cast<const std::byte*>(data) + y * pitch);
            std::transform(row, row + static_cast<std::ptrdiff_t>(4) * width,
                           std::back_inserter(converted), byteOf);
        }
        data = converted.data();
        pitch = static_cast<std::ptrdiff_t>(4) * width;
    }
    glBindTexture(GL_TEXTURE_2D, texture_->id());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, static_cast<GLint>(pitch / layout.bytes));
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, layout.channels, layout.type, data);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

std::size_t TextureCopy::download(void* data, std::ptrdiff_t pitch) {
    const auto [width, height] = texture_->size();
    return download({0, 0, width, height}, data, pitch);
}

// Throws if the GL context was lost. Rows that were not read yet are then unchanged.
std::size_t TextureCopy::download(const PixelRect& part, void* data, std::ptrdiff_t pitch) {
    if (part.empty()) return 0;
    const Layout layout = layoutOf(texture_->format());
    const int bytes = floats_ ? 4 * static_cast<int>(sizeof(float)) : layout.bytes;
    std::byte* first =
        static_cast<std::byte*>(data) + part.y0 * pitch + std::ptrdiff_t{part.x0} * bytes;
    target().bind();
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    if (!floats_ && canRead(layout)) {
        glPixelStorei(GL_PACK_ROW_LENGTH, static_cast<GLint>(pitch / bytes));
        glReadPixels(part.x0, part.y0, part.x1 - part.x0, part.y1 - part.y0, layout.channels,
                     layout.type, first);
        glPixelStorei(GL_PACK_ROW_LENGTH, 0);
        gpu::checkErrors("TextureCopy");
    } else if (floats_) {
        readFourChannels<std::uint8_t>(part, layout.type, first, pitch, takeShares);
    } else if (layout.type == GL_FLOAT) {
        readFourChannels<float>(part, layout.type, first, pitch, takeFirstChannels<float>(1));
    } else {
        readFourChannels<std::uint8_t>(part, layout.type, first, pitch,
                                       takeFirstChannels<std::uint8_t>(layout.bytes));
    }
    return static_cast<std::size_t>(part.area()) * bytes;
}

}  // namespace mfar
