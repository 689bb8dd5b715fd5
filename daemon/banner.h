#pragma once

#include "base/gl/texture.h"
#include "base/rows.h"
#include "hal/picture.h"

#include <cstdint>
#include <string>

namespace mfar {

/// Draws a message about a fault over a picture. Only one thread may use it. For pictures in
/// textures, the GL context must be current on this thread. Memory is allocated when the first
/// message is drawn, and for the text of each new message. Throws GlError.
class Banner {
public:
    explicit Banner(Size size) : size_(size) {}

    /// Returns a copy of the picture with the text at its lower edge. The copy is a texture if
    /// `picture` is a texture, otherwise it is in host memory. If `picture` is empty, the
    /// background is black. The copy is valid until the next call.
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
