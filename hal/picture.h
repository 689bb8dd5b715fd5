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
/// host memory, a pixel four bytes R G B A, row 0 = top row. Alpha means nothing. Borrowed: the
/// pixels stay as they are until the next picture is made.
class Picture {
public:
    Picture() = default;  ///< empty
    /// Empty for texture 0.
    // NOLINTNEXTLINE(google-explicit-constructor): one of the two things that a picture is
    Picture(const GlImage& image) : pixels_(image) {}
    // NOLINTNEXTLINE(google-explicit-constructor): the other
    Picture(const Rows<const std::uint32_t>& rows) : pixels_(rows) {}

    [[nodiscard]] bool isOnHost() const { return std::holds_alternative<HostRows>(pixels_); }
    [[nodiscard]] bool isEmpty() const {
        return isOnHost() ? rows().data == nullptr : image().texture == 0;
    }
    [[nodiscard]] Size size() const { return isOnHost() ? rows().size : image().size; }
    /// Only where it is not on the host.
    [[nodiscard]] const GlImage& image() const {
        assert(!isOnHost());
        return *std::get_if<GlImage>(&pixels_);
    }
    /// Only where it is on the host.
    [[nodiscard]] const Rows<const std::uint32_t>& rows() const {
        assert(isOnHost());
        return *std::get_if<HostRows>(&pixels_);
    }

private:
    using HostRows = Rows<const std::uint32_t>;
    std::variant<GlImage, HostRows> pixels_;
};

/// The pixels of rows as bytes, R first.
[[nodiscard]] inline ImageView viewOf(const Rows<const std::uint32_t>& rows) {
    return {reinterpret_cast<const std::uint8_t*>(rows.data), rows.size,
            static_cast<std::size_t>(rows.pitch) * 4, PixelFormat::Rgba8};
}

/// Copies a picture that is not empty into `rgba`, row 0 first, `stride` bytes from one row to the
/// next, a multiple of four. Reads a texture back: waits for the GPU and leaves the context's
/// bindings as they were. Calls no GL for a picture on the host. Throws std::runtime_error when GL
/// refuses.
void copyPicture(const Picture& picture, std::uint8_t* rgba, std::size_t stride);

}  // namespace mfar
