#pragma once

#include "base/gl/gl.h"
#include "pipeline/warp/warp.h"
#include "tests/warp/cast_scene.h"
#include "tests/warp/warp_engine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mfar::test {

/// PSNR of the colours over the pixels in which `truth` shows an object [dB, peak 255].
inline double psnrInside(const std::vector<std::uint8_t>& rgba, const RenderedPicture& truth) {
    double sum = 0;
    std::size_t values = 0;
    for (std::size_t i = 0; i < truth.id.size(); ++i) {
        if (truth.id[i] == 0 || truth.id[i] == kCatcherId) continue;
        for (std::size_t c = 0; c < 3; ++c, ++values)
            sum += std::pow(rgba[4 * i + c] - truth.colour[i][c], 2);
    }
    return 10 * std::log10(255.0 * 255 * static_cast<double>(values) / sum);
}

inline HoleAnswer answered(const CastScene& scene, const HoleRequest& request, int grid = 2) {
    const RenderedPicture picture = scene.castPixels(request.view, grid, request.pixels);
    HoleAnswer out;
    out.view = request.view;
    out.pixels = request.pixels;
    out.scene = request.scene;
    out.edges = request.edges;
    for (const std::uint32_t pixel : request.pixels) {
        out.colour.push_back(picture.colour[pixel]);
        out.depth.push_back(picture.depth[pixel]);
        out.id.push_back(picture.id[pixel]);
    }
    return out;
}

inline HoleAnswer answeredInWhite(const CastScene& scene, const HoleRequest& request) {
    HoleAnswer out = answered(scene, request);
    std::ranges::fill(out.colour, std::array<std::uint8_t, 4>{255, 255, 255, 255});
    return out;
}

/// Mean green of these pixels in the next frame, whose camera is at this pose.
inline double meanGreen(Warp& warp, const RigidTransform& pose,
                        const std::vector<std::uint32_t>& pixels) {
    const auto rgba = bytesOf(warp.run(pose).colour);
    double sum = 0;
    for (const std::uint32_t pixel : pixels)
        sum += rgba[4UL * pixel + 1];
    return sum / static_cast<double>(pixels.size());
}

/// Runs `frames` frames at this pose and answers all requests for holes. After 12 frames, the
/// answers are fully shown. `pose` should be a variable: GCC 14 warns that the result might refer
/// to a temporary argument.
inline const LayerPicture& settled(Warp& warp, const CastScene& scene, const RigidTransform& pose,
                                   int frames = 12) {
    for (int i = 0; i < frames; ++i) {
        warp.run(pose);
        glFinish();
        if (const auto request = warp.takeRequest()) warp.answer(answered(scene, *request));
    }
    return warp.run(pose);
}

}  // namespace mfar::test
