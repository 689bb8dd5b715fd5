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
}

LayerComposite::Params LayerComposite::params() const {
    const Size output = visibility_.size();
    const double likeness = options_.likeness / 255;
    Params p{};
    p.video[0] = video_.width;
    p.video[1] = video_.height;
    p.video[2] = output.width;
    p.video[3] = output.height;
    p.layer[0] = layer_.width;
    p.layer[1] = layer_.height;
    p.scale[2] = static_cast<float>(layer_.width) / static_cast<float>(output.width);
    p.scale[3] = static_cast<float>(layer_.height) / static_cast<float>(output.height);
    p.scale[0] = static_cast<float>(video_.width) / static_cast<float>(output.width);
    p.scale[1] = static_cast<float>(video_.height) / static_cast<float>(output.height);
    p.tune[0] = static_cast<float>(options_.bias);
    p.tune[1] = static_cast<float>(options_.softness);
    p.tune[2] = static_cast<float>(options_.virtualSigma);
    p.tune[3] = static_cast<float>(0.5 / (likeness * likeness));
    return p;
}

PixelRect LayerComposite::videoPixels(const PixelRect& bounds) const {
    const Size output = visibility_.size();
    const double sx = static_cast<double>(video_.width) / output.width;
    const double sy = static_cast<double>(video_.height) / output.height;
    const auto below = [](int pixel, double scale) {
        return static_cast<int>(std::floor((pixel + 0.5) * scale - 0.5));
    };
    return {std::max(below(bounds.x0, sx), 0), std::max(below(bounds.y0, sy), 0),
            std::min(below(bounds.x1, sx) + 1, video_.width),
            std::min(below(bounds.y1, sy) + 1, video_.height)};
}

void LayerComposite::run(const VirtualLayer& layer, const gpu::Texture& realDepth,
                         const gpu::Texture& video, const gpu::Texture& picture,
                         const gpu::Framebuffer& target) {
    assert(realDepth.size() == video_ && video.size() == video_);
    assert(picture.size() == visibility_.size());
    assert(layer.colour->size() == layer_ && layer.depth->size() == layer_);
    const PixelRect bounds = layerInOutput(layer.bounds, layer_, visibility_.size());
    if (bounds.empty()) return;
    const Params p = params();
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
