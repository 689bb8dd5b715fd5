#pragma once

#include "base/gl/texture.h"
#include "base/rows.h"
#include "hal/picture.h"

#include <cstdint>
#include <string>

namespace mfar {

/// Draws a fault's text over a picture. Used by one thread; for pictures in textures, by the GL
/// thread with its context current. Allocates nothing before the first fault. Throws GlError.
class Banner {
public:
    /// `size`: of the pictures.
    explicit Banner(Size size) : size_(size) {}

    /// A copy of the picture with the text across its lower edge, in a texture or on the host, as
    /// the picture itself. An empty picture gives the text over black, on the host. Valid until the
    /// next call.
    [[nodiscard]] Picture over(const Picture& picture, const std::string& text);

private:
    [[nodiscard]] Picture overRows(const Picture& picture);
    [[nodiscard]] Picture overTexture(const Picture& picture);
    void write(const std::string& text);

    Size size_;
    std::string text_;
    AlignedRows<std::uint32_t> strip_, rows_;
    bool stripUploaded_ = false;
    gpu::Texture texture_, stripTexture_;
    gpu::Framebuffer target_, stripTarget_;
};

}  // namespace mfar
