#pragma once

#include "base/gl/gl.h"

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

namespace mfar::gpu {

/// A GL buffer object of fixed size in bytes, for shader storage, uniforms, draw commands, vertices
/// or indices. It is initially zero. Move-only. Its GL context must be current whenever the object
/// is used or destroyed.
class Buffer {
public:
    Buffer() = default;
    explicit Buffer(std::size_t bytes);
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;
    ~Buffer();

    [[nodiscard]] GLuint id() const { return id_; }
    [[nodiscard]] std::size_t bytes() const { return bytes_; }

    template <class T>
    void write(std::span<const T> values, std::size_t offsetBytes = 0) {
        static_assert(std::is_trivially_copyable_v<T>);
        writeBytes(values.data(), values.size_bytes(), offsetBytes);
    }
    /// Returns `count` values of the buffer. Waits until the GPU has written them. Code that runs
    /// in every frame may read only a buffer that was written at least one frame earlier.
    template <class T>
    [[nodiscard]] std::vector<T> read(std::size_t count, std::size_t offsetBytes = 0) const {
        static_assert(std::is_trivially_copyable_v<T>);
        std::vector<T> out(count);
        readBytes(out.data(), count * sizeof(T), offsetBytes);
        return out;
    }

private:
    void writeBytes(const void* data, std::size_t bytes, std::size_t offset);
    void readBytes(void* out, std::size_t bytes, std::size_t offset) const;

    GLuint id_ = 0;
    std::size_t bytes_ = 0;
};

}  // namespace mfar::gpu
