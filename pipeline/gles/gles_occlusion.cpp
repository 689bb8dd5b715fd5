#include "pipeline/gles/device_copies.h"
#include "pipeline/gles/gles_steps.h"
#include "pipeline/gles/layer_composite.h"

#include <cmath>
#include <span>
#include <vector>

namespace mfar::gles {
namespace {

class GlesOcclusion final : public OcclusionStep {
public:
    GlesOcclusion(const StepSetup& setup, Size layer, FrameOnGpu& frame)
        : video_(setup.rig.video.size), frame_(frame), composite_(video_, setup.output, layer),
          depth_(video_, gpu::TexelFormat::Rg32F), values_(2UL * video_.width * video_.height),
          uploaded_{0, 0, video_.width, video_.height} {}

    void draw(const LayerPicture& layer, const InverseDepthField& real, const PixelRect& where,
              const VideoFrame& frame, Field<std::uint32_t>& picture) override {
        upload(real, where);
        const VirtualLayer on{
            &textureOf(layer.colour, gpu::TexelFormat::Rgba8, gpu::Filter::Linear).texture(),
            &textureOf(layer.depth, gpu::TexelFormat::R32F).texture(), layer.bounds};
        TextureCopy& target = textureOf(picture, gpu::TexelFormat::Rgba8);
        composite_.run(on, depth_, frame_.video(frame), target.texture(), target.target());
        picture.writtenOnDevice(target, picture.size());
    }

    std::vector<float> visibility() const override {
        const std::vector<std::uint8_t> read = composite_.visibility().readRgba8();
        std::vector<float> out;
        out.reserve(read.size() / 4);
        for (std::size_t i = 0; i < read.size(); i += 4)
            out.push_back(static_cast<float>(read[i]) / 255);
        return out;
    }

private:
    // Uploads the depths in the rows of `where`, and in the rows of the last upload, whose depths
    // outside `where` are now unknown.
    void upload(const InverseDepthField& real, const PixelRect& where) {
        const PixelRect rows = around(uploaded_, where);
        uploaded_ = where;
        if (rows.empty()) return;
        const std::size_t first = static_cast<std::size_t>(rows.y0) * video_.width;
        const std::size_t last = static_cast<std::size_t>(rows.y1) * video_.width;
        for (std::size_t i = first; i < last; ++i) {
            const bool known = real.isKnown(i);
            values_[2 * i] = known ? real.inverseDepth[i] : 0.0F;
            values_[2 * i + 1] = known ? std::sqrt(real.variance[i]) : -1.0F;
        }
        depth_.upload(std::span(values_).subspan(2 * first, 2 * (last - first)), rows.y0);
    }

    Size video_;
    FrameOnGpu& frame_;
    LayerComposite composite_;
    gpu::Texture depth_;
    std::vector<float> values_;
    PixelRect uploaded_;
};

}  // namespace

std::unique_ptr<OcclusionStep> makeOcclusionStep(const StepSetup& setup, Size layer,
                                                 FrameOnGpu& frame) {
    return std::make_unique<GlesOcclusion>(setup, layer, frame);
}

}  // namespace mfar::gles
