#include "pipeline/composite/composite.h"

#include "pipeline/gpu/scoped_state.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>

namespace mfar {
namespace {

void require(const char* name, double value, double least) {
    constexpr double kMost = 1000;
    if (!(value >= least && value <= kMost))
        throw std::invalid_argument("composite option " + std::string(name) + " is " +
                                    std::to_string(value) + ", not from " + std::to_string(least) +
                                    " to 1000");
}

}  // namespace

Composite::Composite(Size video, Size output, const CompositeOptions& options)
    : video_(video), options_(options), range_(video, gpu::TexelFormat::Rg32F),
      visibility_(output, gpu::TexelFormat::R8), rangeTarget_(range_),
      visibilityTarget_(visibility_), rangePass_("visibility_range.frag"),
      samplePass_("visibility_sample.frag"), blendPass_("visibility_blend.frag") {
    require("bias", options.bias, 0);
    require("softness", options.softness, 0.01);
    require("virtualSigma", options.virtualSigma, 0);
    require("likeness", options.likeness, 0.1);
}

Composite::Params Composite::params() const {
    const Size output = visibility_.size();
    const double likeness = options_.likeness / 255;
    Params p{};
    p.video[0] = video_.width;
    p.video[1] = video_.height;
    p.video[2] = output.width;
    p.video[3] = output.height;
    p.scale[0] = static_cast<float>(video_.width) / static_cast<float>(output.width);
    p.scale[1] = static_cast<float>(video_.height) / static_cast<float>(output.height);
    p.tune[0] = static_cast<float>(options_.bias);
    p.tune[1] = static_cast<float>(options_.softness);
    p.tune[2] = static_cast<float>(options_.virtualSigma);
    p.tune[3] = static_cast<float>(0.5 / (likeness * likeness));
    return p;
}

PixelRect Composite::videoPixels(const PixelRect& bounds) const {
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

void Composite::run(const VirtualLayer& layer, const gpu::Texture& realDepth,
                    const gpu::Texture& video, const gpu::Texture& picture,
                    const gpu::Framebuffer& target) {
    const Size output = visibility_.size();
    assert(realDepth.size() == video_ && video.size() == video_ && picture.size() == output);
    assert(layer.colour->size() == output && layer.depth->size() == output);
    const PixelRect bounds{std::max(layer.bounds.x0, 0), std::max(layer.bounds.y0, 0),
                           std::min(layer.bounds.x1, output.width),
                           std::min(layer.bounds.y1, output.height)};
    if (bounds.empty()) return;
    const Params p = params();
    {
        const gpu::Scissor scissor(videoPixels(bounds));
        rangePass_.run(p, {gpu::sampler(0, realDepth)}, rangeTarget_);
    }
    const gpu::Scissor scissor(bounds);
    samplePass_.run(p,
                    {gpu::sampler(0, *layer.depth), gpu::sampler(1, range_),
                     gpu::sampler(2, realDepth), gpu::sampler(3, video), gpu::sampler(4, picture)},
                    visibilityTarget_);
    const gpu::PremultipliedBlend blend;
    blendPass_.run(p, {gpu::sampler(0, *layer.colour), gpu::sampler(1, visibility_)}, target);
}

}  // namespace mfar
