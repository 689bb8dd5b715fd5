#include "base/gl/buffer.h"

#include "base/gl/validation.h"

#include <cassert>
#include <cstdint>
#include <cstring>
#include <utility>

namespace mfar::gpu {

Buffer::Buffer(std::size_t bytes) : bytes_(bytes) {
    checkErrors("a call before Buffer()");
    glGenBuffers(1, &id_);
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, id_);
    std::vector<std::uint8_t> contents(bytes);
    if (Validation* validation = Validation::active()) {
        contents.resize(bytes + Validation::kGuardBytes, 0xFF);
        validation->guard(id_, bytes);
    }
    glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(contents.size()),
                 contents.data(), GL_DYNAMIC_COPY);
    checkErrors("Buffer");
}

Buffer::Buffer(Buffer&& other) noexcept
    : id_(std::exchange(other.id_, 0)), bytes_(std::exchange(other.bytes_, 0)) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

Buffer::~Buffer() {
    if (id_ != 0) glDeleteBuffers(1, &id_);
}

void Buffer::writeBytes(const void* data, std::size_t bytes, std::size_t offset) {
    assert(offset + bytes <= bytes_);
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, id_);
    glBufferSubData(GL_SHADER_STORAGE_BUFFER, static_cast<GLintptr>(offset),
                    static_cast<GLsizeiptr>(bytes), data);
}

void Buffer::readBytes(void* out, std::size_t bytes, std::size_t offset) const {
    assert(offset + bytes <= bytes_);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, id_);
    const void* mapped = glMapBufferRange(GL_SHADER_STORAGE_BUFFER, static_cast<GLintptr>(offset),
                                          static_cast<GLsizeiptr>(bytes), GL_MAP_READ_BIT);
    if (mapped == nullptr) throw GlError("the GPU buffer cannot be mapped for reading");
    std::memcpy(out, mapped, bytes);
    glUnmapBuffer(GL_SHADER_STORAGE_BUFFER);
}

}  // namespace mfar::gpu
