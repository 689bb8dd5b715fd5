#pragma once

#include "pipeline/engine/engine.h"
#include "pipeline/gles/picture_texture.h"
#include "pipeline/gles/tile_buffer.h"
#include "pipeline/superres/still_scale.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace mfar::gles {

/// The video frame and its TileWork, stored on the GPU. They are uploaded when the first step of a
/// frame needs them. All steps of the engine share this object. It needs a current GL context for
/// its whole lifetime.
class FrameOnGpu {
public:
    explicit FrameOnGpu(Size video) : tiles_{TileBuffer(video), TileBuffer(video)} {}

    [[nodiscard]] const gpu::Texture& video(const VideoFrame& frame);
    /// Returns the GPU's copy of `work`. The last two copies are stored, because a frame has one
    /// TileWork for each of up to two stills.
    [[nodiscard]] const TileBuffer& tiles(const TileWork& work);
    [[nodiscard]] gpu::PictureTexture& stillPicture() { return still_; }
    void setImporter(PlaneImporter* importer);
    [[nodiscard]] std::optional<std::string> takeImportFault();
    void finishReading() { video_.finishReading(); }

private:
    gpu::PictureTexture video_, still_{gpu::Filter::Linear};
    std::optional<std::uint64_t> number_;
    std::array<TileBuffer, 2> tiles_;
    std::size_t used_ = 0;
};

[[nodiscard]] std::unique_ptr<StillStep> makeStillStep(const StepSetup& setup, FrameOnGpu& frame);
[[nodiscard]] std::unique_ptr<PyramidStep> makePyramidStep(const StepSetup& setup,
                                                           FrameOnGpu& frame);
/// The still camera of `stillRig` must have the resolution of the stills' StillPictures::raised.
[[nodiscard]] std::unique_ptr<FlowStep> makeFlowStep(const StepSetup& setup,
                                                     const StereoRig& stillRig, FrameOnGpu& frame);
[[nodiscard]] std::unique_ptr<WeighStep>
makeWeighStep(const StepSetup& setup, const StereoRig& stillRig, FrameOnGpu& frame);
[[nodiscard]] std::unique_ptr<DetailStep>
makeDetailStep(const StepSetup& setup, const StereoRig& stillRig, FrameOnGpu& frame);
[[nodiscard]] std::unique_ptr<OcclusionStep> makeOcclusionStep(const StepSetup& setup, Size layer,
                                                               FrameOnGpu& frame);
[[nodiscard]] std::unique_ptr<WarpStep>
makeWarpStep(const StepSetup& setup, const CameraModel& layer, const WarpOptions& options);

}  // namespace mfar::gles
