#pragma once

#include "base/gl/texture.h"
#include "hal/display.h"

#include <string>

namespace mfar {

/// Says on the picture what is wrong. Lives on the GL thread with its context current; allocates
/// nothing before it is first needed. Throws GlError.
class Banner {
public:
    /// `size` of the pictures.
    explicit Banner(Size size) : size_(size) {}

    /// A copy of the picture with the text across its lower edge, over black where there is no
    /// picture (texture 0). Valid until the next call.
    [[nodiscard]] GlImage over(const GlImage& picture, const std::string& text);

private:
    void write(const std::string& text);

    Size size_;
    std::string text_;
    gpu::Texture picture_, strip_;
    gpu::Framebuffer pictureTarget_, stripTarget_;
};

}  // namespace mfar
