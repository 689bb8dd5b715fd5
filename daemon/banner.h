#pragma once

#include "base/gl/texture.h"
#include "base/rows.h"
#include "hal/picture.h"

#include <cstdint>
#include <string>

namespace mfar {

/// Says on the picture what is wrong. Lives on one thread; where pictures are textures, on the GL
/// thread with its context current. Allocates nothing before it is first needed. Throws GlError.
class Banner {
public:
    /// `size` of the pictures.
    explicit Banner(Size size) : size_(size) {}

    /// A copy of the picture with the text across its lower edge, where the picture is: in a
    /// texture or on the host. Over black, on the host, where the picture is empty. Valid until the
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
