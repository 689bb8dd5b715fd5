#pragma once

#include "base/gl/pass.h"
#include "pipeline/engine/params/detail.h"
#include "tests/engine/pictures.h"
#include "tests/oracle/luma.h"

namespace mfar {

using TileParams = params::DrawTiles;

inline TileParams tileParams(Size video, Size still, Size output) {
    TileParams p{};
    p.videoWidth = video.width;
    p.videoHeight = video.height;
    p.cellColumns = (video.width + 3) / 4;
    p.cellRows = (video.height + 3) / 4;
    p.scaleX = static_cast<float>(video.width) / static_cast<float>(output.width);
    p.scaleY = static_cast<float>(video.height) / static_cast<float>(output.height);
    p.stillTexelX = 1.0F / static_cast<float>(still.width);
    p.stillTexelY = 1.0F / static_cast<float>(still.height);
    p.stillScaleX = static_cast<float>(still.width) / static_cast<float>(output.width);
    p.stillScaleY = static_cast<float>(still.height) / static_cast<float>(output.height);
    return p;
}

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
