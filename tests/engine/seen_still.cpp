#include "tests/engine/seen_still.h"

#include "pipeline/gles/device_copies.h"
#include "tests/oracle/patch.h"

#include <algorithm>
#include <cmath>

namespace mfar {

SeenStill::SeenStill(const StereoRig& cameras,
                     const std::function<double(const Eigen::Vector2d&)>& luma,
                     const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& flow,
                     double light)
    : rig(cameras), video(cameras.video.size) {
    still = twin::greyOf(rig.still.size, [&](int x, int y) {
        return std::clamp(std::round(luma(Eigen::Vector2d(x, y))), 0.0, 255.0);
    });
    bytes_.assign(still.values.begin(), still.values.end());
    grey = twin::greyOf(rig.video.size, [&](int x, int y) {
        double sum = 0, squares = 0;
        for (int k = 0; k < 36; ++k) {
            const int column = k % 6, row = k / 6;
            const Eigen::Vector2d p(x + (column + 0.5) / 6 - 0.5, y + (row + 0.5) / 6 - 0.5);
            const double seen = luma(twin::stillPixel(rig, p + flow(p)));
            sum += seen / 36;
            squares += seen * seen / 36;
        }
        return std::clamp(std::round(std::lerp(sum, std::sqrt(squares), light)), 0.0, 255.0);
    });
    for (const double v : grey.values)
        pixels_.insert(pixels_.end(), {static_cast<std::uint8_t>(v), static_cast<std::uint8_t>(v),
                                       static_cast<std::uint8_t>(v), 255});
    video.take(videoView());
    for (int y = 0; y < rig.still.size.height; ++y)
        for (int x = 0; x < rig.still.size.width; ++x)
            words_.push_back(static_cast<std::uint16_t>(
                static_cast<int>(still.at(x, y)) + 256 * static_cast<int>(still.at(x, y + 1))));
    words_.resize(words_.size() + 64);
}

gpu::Texture SeenStill::stillTexture() const {
    gpu::Texture out(rig.still.size, gpu::TexelFormat::R8, gpu::Filter::Linear);
    TextureCopy(out).upload(bytes_.data(), rig.still.size.width);
    return out;
}

gpu::Texture SeenStill::videoTexture() const {
    gpu::Texture out(rig.video.size, gpu::TexelFormat::Rgba8);
    TextureCopy(out).upload(pixels_.data(), 4L * rig.video.size.width);
    return out;
}

}  // namespace mfar
