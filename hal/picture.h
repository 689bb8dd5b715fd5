#pragma once

#include "base/rows.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <variant>

namespace mfar {

/// A finished picture in the current GL context: RGBA8 2-D texture, row 0 = top row of the picture.
struct GlImage {
    unsigned texture = 0;
    Size size;
};

/// A finished picture where its engine left it: a texture of the current GL context, or rows of
/// host memory with four bytes R G B A per pixel; row 0 = top row. Alpha is undefined. Borrowed:
/// the pixels stay valid until the next picture is made.
class Picture {
public:
    Picture() = default;  ///< empty
    /// Texture 0: an empty picture.
    // NOLINTNEXTLINE(google-explicit-constructor): one of the two things that a picture is
    Picture(const GlImage& image) : pixels_(image) {}
    // NOLINTNEXTLINE(google-explicit-constructor): the other
    Picture(const Rows<const std::uint32_t>& rows) : pixels_(rows) {}

    [[nodiscard]] bool isOnHost() const { return std::holds_alternative<HostRows>(pixels_); }
    [[nodiscard]] bool isEmpty() const {
        return isOnHost() ? rows().data == nullptr : image().texture == 0;
    }
    [[nodiscard]] Size size() const { return isOnHost() ? rows().size : image().size; }
    /// Only valid if the picture is not on the host.
    [[nodiscard]] const GlImage& image() const {
        assert(!isOnHost());
        return *std::get_if<GlImage>(&pixels_);
    }
    /// Only valid if the picture is on the host.
    [[nodiscard]] const Rows<const std::uint32_t>& rows() const {
        assert(isOnHost());
        return *std::get_if<HostRows>(&pixels_);
    }

private:
    using HostRows = Rows<const std::uint32_t>;
    std::variant<GlImage, HostRows> pixels_;
};

/// A view of the rows' pixels as bytes, R first.
[[nodiscard]] inline ImageView viewOf(const Rows<const std::uint32_t>& rows) {
    return {reinterpret_cast<const std::uint8_t*>(rows.data), rows.size,
            static_cast<std::size_t>(rows.pitch) * 4, PixelFormat::Rgba8};
}

/// Copies a non-empty picture into `rgba`, row 0 first; `stride` [bytes] is a multiple of four. A
/// texture is read back: waits for the GPU and preserves the context's bindings. Makes no GL call
/// for a picture on the host. Throws std::runtime_error when GL fails.
void copyPicture(const Picture& picture, std::uint8_t* rgba, std::size_t stride);

}  // namespace mfar
