#pragma once

#include "base/geometry.h"
#include "base/gl/buffer.h"
#include "base/gl/texture.h"
#include "pipeline/engine/field.h"

#include <cstddef>
#include <memory>
#include <optional>

namespace mfar {

/// The GPU's copy of a field that has a single row, as a storage buffer.
class BufferCopy final : public DeviceCopy {
public:
    /// Refers to a part of a step's buffer: `count` entries of `entryBytes` bytes, beginning with
    /// entry `first`.
    BufferCopy(const gpu::Buffer& buffer, int first, std::size_t count, std::size_t entryBytes)
        : buffer_(&buffer), first_(first), count_(count), entryBytes_(entryBytes) {}
    BufferCopy(std::size_t count, std::size_t entryBytes)
        : own_(count * entryBytes), buffer_(&*own_), count_(count), entryBytes_(entryBytes) {}

    [[nodiscard]] const gpu::Buffer& buffer() const { return *buffer_; }
    [[nodiscard]] int first() const { return first_; }

    /// Must be called only if the object was constructed without a step's buffer.
    void upload(const void* data, std::ptrdiff_t pitch) override;
    std::size_t download(void* data, std::ptrdiff_t pitch) override;

private:
    std::optional<gpu::Buffer> own_;
    const gpu::Buffer* buffer_;
    int first_ = 0;
    std::size_t count_, entryBytes_;
};

/// The GPU's copy of a field, as a texture. In CPU memory, a texel has one byte for R8, two bytes
/// for Rg8, four bytes for Rgba8, one float for R32F, and four floats for other formats. If
/// `floats` is true, the texture is Rgba8, but a texel in CPU memory has four floats in [0, 1].
class TextureCopy : public DeviceCopy {
public:
    /// Refers to a step's texture, which must outlive this object.
    explicit TextureCopy(const gpu::Texture& texture, bool floats = false)
        : texture_(&texture), floats_(floats) {}
    TextureCopy(Size size, gpu::TexelFormat format, gpu::Filter filter, bool floats = false)
        : own_(std::in_place, size, format, filter), texture_(&*own_), floats_(floats) {}

    [[nodiscard]] const gpu::Texture& texture() const { return *texture_; }
    [[nodiscard]] const gpu::Framebuffer& target();

    void upload(const void* data, std::ptrdiff_t pitch) override;
    std::size_t download(void* data, std::ptrdiff_t pitch) override;

protected:
    /// Copies only the pixels of `part`, which must lie within the texture. `data` is the address
    /// of the first pixel of the whole picture.
    std::size_t download(const PixelRect& part, void* data, std::ptrdiff_t pitch);

private:
    std::optional<gpu::Texture> own_;
    const gpu::Texture* texture_;
    std::optional<gpu::Framebuffer> target_;
    bool floats_;
};

template <class T>
[[nodiscard]] const BufferCopy& bufferOf(const Field<T>& field) {
    DeviceCopy& copy = field.device([&] {
        return std::make_unique<BufferCopy>(static_cast<std::size_t>(field.size().width),
                                            sizeof(T));
    });
    return static_cast<const BufferCopy&>(copy);
}

template <class T>
[[nodiscard]] TextureCopy& textureOf(const Field<T>& field, gpu::TexelFormat format,
                                     gpu::Filter filter = gpu::Filter::Nearest,
                                     bool floats = false) {
    DeviceCopy& copy = field.device(
        [&] { return std::make_unique<TextureCopy>(field.size(), format, filter, floats); });
    return static_cast<TextureCopy&>(copy);
}

}  // namespace mfar
