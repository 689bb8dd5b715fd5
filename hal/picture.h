#pragma once

#include "base/rows.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <variant>

namespace mfar {

/// A texture of format RGBA8 in the current GL context. Row 0 is the top row.
struct GlImage {
    unsigned texture = 0;
    Size size;
};

/// A finished picture: either a texture (GLES engine), or rows in host memory with bytes R G B A
/// (SIMD engine). Row 0 is the top row. Alpha is undefined. The engine owns the pixels; they are
/// valid until the engine makes the next picture.
class Picture {
public:
    Picture() = default;
    // NOLINTNEXTLINE(google-explicit-constructor): a Picture is a variant of the two types
    Picture(const GlImage& image) : pixels_(image) {}
    // NOLINTNEXTLINE(google-explicit-constructor): a Picture is a variant of the two types
    Picture(const Rows<const std::uint32_t>& rows) : pixels_(rows) {}

    [[nodiscard]] bool isOnHost() const { return std::holds_alternative<HostRows>(pixels_); }
    [[nodiscard]] bool isEmpty() const {
        return isOnHost() ? rows().data == nullptr : image().texture == 0;
    }
    [[nodiscard]] Size size() const { return isOnHost() ? rows().size : image().size; }
    [[nodiscard]] const GlImage& image() const {
        assert(!isOnHost());
        return *std::get_if<GlImage>(&pixels_);
    }
    [[nodiscard]] const Rows<const std::uint32_t>& rows() const {
        assert(isOnHost());
        return *std::get_if<HostRows>(&pixels_);
    }

private:
    using HostRows = Rows<const std::uint32_t>;
    std::variant<GlImage, HostRows> pixels_;
};

[[nodiscard]] inline ImageView viewOf(const Rows<const std::uint32_t>& rows) {
    return {reinterpret_cast<const std::uint8_t*>(rows.data), rows.size,
            static_cast<std::size_t>(rows.pitch) * 4, PixelFormat::Rgba8};
}

/// Copies a picture that is not empty into `rgba`, row 0 first. `stride` [bytes] must be a multiple
/// of four. Reading a texture waits for the GPU and keeps the context's bindings. Throws
/// std::runtime_error if GL cannot read from the texture.
void copyPicture(const Picture& picture, std::uint8_t* rgba, std::size_t stride);

}  // namespace mfar
