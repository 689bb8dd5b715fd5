#pragma once

#include "base/gl/pass.h"
#include "tests/engine/pictures.h"
#include "tests/oracle/luma.h"

namespace mfar {

/// Mirrors tile_params.glsl.
struct TileParams {
    std::int32_t video[4]{};
    float scale[4]{}, tune[4]{};
};

/// Cells, scales and look-up steps of ideal cameras, without sharpening.
inline TileParams tileParams(Size video, Size still, Size output) {
    TileParams p;
    p.video[0] = video.width;
    p.video[1] = video.height;
    p.video[2] = (video.width + 3) / 4;
    p.video[3] = (video.height + 3) / 4;
    p.scale[0] = static_cast<float>(video.width) / static_cast<float>(output.width);
    p.scale[1] = static_cast<float>(video.height) / static_cast<float>(output.height);
    p.scale[2] = 1.0F / static_cast<float>(still.width);
    p.scale[3] = 1.0F / static_cast<float>(still.height);
    p.tune[2] = static_cast<float>(still.width) / static_cast<float>(output.width);
    p.tune[3] = static_cast<float>(still.height) / static_cast<float>(output.height);
    return p;
}

/// What a fragment shader draws over a whole RGBA8 target.
inline gpu::Texture drawn(const char* shader, const TileParams& params, gpu::Bindings bindings,
                          Size size) {
    gpu::Texture out(size, gpu::TexelFormat::Rgba8);
    const gpu::Framebuffer target(out);
    gpu::DrawPass<TileParams> pass(shader);
    pass.run(params, bindings, target);
    return out;
}

inline twin::Grey channelOf(const gpu::Texture& t, int channel) {
    const auto bytes = t.readRgba8();
    return twin::greyOf(t.size(), [&](int x, int y) {
        return double(bytes[4UL * (1UL * y * t.size().width + x) + channel]);
    });
}

}  // namespace mfar
