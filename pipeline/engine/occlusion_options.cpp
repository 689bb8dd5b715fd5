#include "pipeline/engine/occlusion_options.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace mfar {
namespace {

void require(const char* name, double value, double least) {
    constexpr double kMost = 1000;
    if (!(value >= least && value <= kMost))
        throw std::invalid_argument("composite option " + std::string(name) + " is " +
                                    std::to_string(value) + ", but must be from " +
                                    std::to_string(least) + " to 1000");
}

}  // namespace

void validate(const CompositeOptions& options) {
    require("bias", options.bias, 0);
    require("softness", options.softness, 0.01);
    require("virtualSigma", options.virtualSigma, 0);
    require("likeness", options.likeness, 0.1);
}

PixelRect layerInOutput(const PixelRect& layerPixels, Size layer, Size output) {
    const PixelRect all{0, 0, output.width, output.height};
    if (layerPixels.empty() || layer == output) return common(layerPixels, all);
    // The result has a margin of one layer pixel, because output pixels interpolate linearly
    // between layer pixels.
    const auto to = [](int pixel, int from, int size) {
        return static_cast<double>(pixel) * size / from;
    };
    return common(
        {static_cast<int>(std::floor(to(layerPixels.x0 - 1, layer.width, output.width))),
         static_cast<int>(std::floor(to(layerPixels.y0 - 1, layer.height, output.height))),
         static_cast<int>(std::ceil(to(layerPixels.x1 + 1, layer.width, output.width))),
         static_cast<int>(std::ceil(to(layerPixels.y1 + 1, layer.height, output.height)))},
        all);
}

}  // namespace mfar
