#pragma once

#include <cstdint>

// Parameters of display_scale.frag, which draws a picture on a screen. Shaders read this header,
// too: gles_shaders/params_to_glsl.cmake.
namespace mfar::params {

struct alignas(16) ScalePicture {
    std::int32_t left, top, width, height;     ///< picture's rectangle [px of the screen]
    float scaleX, scaleY;                      ///< pixels of the picture per pixel of the screen
    float footprintX, footprintY;              ///< [px of the picture], at least 1
    std::int32_t pictureWidth, pictureHeight;  ///< [px]
    std::int32_t blueFirst;                    ///< 1: blue is written first
};

}  // namespace mfar::params
