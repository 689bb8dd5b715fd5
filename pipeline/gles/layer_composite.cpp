#include "pipeline/gles/layer_composite.h"

#include "base/gl/scoped_state.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace mfar {
namespace {

constexpr const char* kScaled = "#define SCALED_LAYER 1\n";

}  // namespace

LayerComposite::LayerComposite(Size video, Size output, Size layer, const CompositeOptions& options)
    : video_(video), layer_(layer), options_(options), range_(video, gpu::TexelFormat::Rg32F),
      visibility_(output, gpu::TexelFormat::R8), open_(output, gpu::TexelFormat::Depth24),
      rangeTarget_(range_),
      visibilityTarget_(std::array<const gpu::Texture*, 1>{&visibility_}, &open_),
      rangePass_("visibility_range.frag"),
      decidePass_("visibility_decide.frag", layer == output ? "" : kScaled),
      samplePass_("visibility_sample.frag", layer == output ? "" : kScaled),
      blendPass_("visibility_blend.frag", layer == output ? "" : kScaled) {
    validate(options);
    // Clears the texture, because run() does not write outside the layer's bounds.
    constexpr std::array<GLfloat, 4> kNothing{};
    visibilityTarget_.bind();
    glClearBufferfv(GL_COLOR, 0, kNothing.data());
}

params::Visibility LayerComposite::visibilityParams() const {
    const Size output = visibility_.size();
    const double likeness = options_.likeness / 255;
    const auto ratio = [](int a, int b) { return static_cast<float>(a) / static_cast<float>(b); };
    return {.videoWidth = video_.width,
            .videoHeight = video_.height,
            .outputWidth = output.width,
            .outputHeight = output.height,
            .layerWidth = layer_.width,
            .layerHeight = layer_.height,
            .scaleX = ratio(video_.width, output.width),
            .scaleY = ratio(video_.height, output.height),
            .layerScaleX = ratio(layer_.width, output.width),
            .layerScaleY = ratio(layer_.height, output.height),
            .bias = static_cast<float>(options_.bias),
            .softness = static_cast<float>(options_.softness),
            .virtualSigma = static_cast<float>(options_.virtualSigma),
            .likeness = static_cast<float>(0.5 / (likeness * likeness))};
}

PixelRect LayerComposite::videoPixels(const PixelRect& bounds) const {
    const Size output = visibility_.size();
    const double sx = static_cast<double>(video_.width) / output.width;
    const double sy = static_cast<double>(video_.height) / output.height;
    const auto below = [](int pixel, double scale) {
        return static_cast<int>(std::floor((pixel + 0.5) * scale - 0.5));
    };
    // Near the left and upper border, below() can be -1 even for x1 and y1. The shader then reads
    // column or row 0, so the rectangle must contain it.
    return {std::max(below(bounds.x0, sx), 0), std::max(below(bounds.y0, sy), 0),
            std::clamp(below(bounds.x1, sx) + 1, 1, video_.width),
            std::clamp(below(bounds.y1, sy) + 1, 1, video_.height)};
}

void LayerComposite::run(const VirtualLayer& layer, const gpu::Texture& realDepth,
                         const gpu::Texture& video, const gpu::Texture& picture,
                         const gpu::Framebuffer& target) {
    assert(realDepth.size() == video_ && video.size() == video_);
    assert(picture.size() == visibility_.size());
    assert(layer.colour->size() == layer_ && layer.depth->size() == layer_);
    const PixelRect bounds = layerInOutput(layer.bounds, layer_, visibility_.size());
    if (bounds.empty()) return;
    const params::Visibility p = visibilityParams();
    {
        const gpu::Scissor scissor(videoPixels(bounds));
        rangePass_.run(p, {gpu::sampler(0, realDepth)}, rangeTarget_);
    }
    const gpu::Scissor scissor(bounds);
    {
        const gpu::DepthWritten open;
        decidePass_.run(p, {gpu::sampler(0, *layer.depth), gpu::sampler(1, range_)},
                        visibilityTarget_);
    }
    {
        const gpu::DepthTest left;
        samplePass_.run(p,
                        {gpu::sampler(0, *layer.depth), gpu::sampler(1, realDepth),
                         gpu::sampler(2, video), gpu::sampler(3, picture)},
                        visibilityTarget_);
    }
    const gpu::PremultipliedBlend blend;
    blendPass_.run(p, {gpu::sampler(0, *layer.colour), gpu::sampler(1, visibility_)}, target);
}

}  // namespace mfar
