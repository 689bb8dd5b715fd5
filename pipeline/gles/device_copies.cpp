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

}  // namespace

void BufferCopy::upload(const void* data, std::ptrdiff_t) {
    const std::span bytes(static_cast<const std::byte*>(data), count_ * entryBytes_);
    assert(own_);
    own_->write(bytes);
}

void BufferCopy::download(void* data, std::ptrdiff_t) {
    const auto bytes = buffer_->read<std::byte>(count_ * entryBytes_,
                                                static_cast<std::size_t>(first_) * entryBytes_);
    std::ranges::copy(bytes, static_cast<std::byte*>(data));
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

// Always reads back four channels, because every driver supports this.
void TextureCopy::download(void* data, std::ptrdiff_t pitch) {
    const auto [width, height] = texture_->size();
    const Layout layout = layoutOf(texture_->format());
    target().bind();
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    if (layout.channels == GL_RGBA && !floats_) {
        glPixelStorei(GL_PACK_ROW_LENGTH, static_cast<GLint>(pitch / layout.bytes));
        glReadPixels(0, 0, width, height, layout.channels, layout.type, data);
        glPixelStorei(GL_PACK_ROW_LENGTH, 0);
        // Throws if the GL context was lost: `data` is then unchanged.
        gpu::checkErrors("TextureCopy");
        return;
    }
    const auto row = [&](int y) { return static_cast<std::byte*>(data) + y * pitch; };
    const std::size_t values = static_cast<std::size_t>(4) * width;
    if (layout.type == GL_FLOAT) {
        const std::vector<float> read = texture_->readRgba32F();
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                reinterpret_cast<float*>(row(y))[x] = read[y * values + 4UL * x];
        return;
    }
    const std::vector<std::uint8_t> read = texture_->readRgba8();
    for (int y = 0; y < height; ++y) {
        const std::uint8_t* from = read.data() + y * values;
        if (floats_)
            std::transform(from, from + values, reinterpret_cast<float*>(row(y)),
                           [](std::uint8_t v) { return static_cast<float>(v) / 255; });
        else
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < layout.bytes; ++c)
                    row(y)[x * layout.bytes + c] = static_cast<std::byte>(from[4 * x + c]);
    }
}

}  // namespace mfar
