#pragma once

#include "pipeline/engine/engine.h"
#include "pipeline/gles/picture_texture.h"
#include "pipeline/gles/tile_buffer.h"
#include "pipeline/superres/still_scale.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace mfar::gles {

/// The frame and its plan on the GPU, uploaded when the first step of a frame needs them. Shared by
/// the engine's steps; needs a current context for its whole life.
class FrameOnGpu {
public:
    explicit FrameOnGpu(Size video) : tiles_(video) {}

    [[nodiscard]] const gpu::Texture& video(const VideoFrame& frame);
    [[nodiscard]] const TileBuffer& tiles(const TileWork& work) {
        tiles_.set(work);
        return tiles_;
    }
    /// See gpu::PictureTexture; for the video and for stills.
    [[nodiscard]] gpu::PictureTexture& stillPicture() { return still_; }
    void setImporter(PlaneImporter* importer);
    [[nodiscard]] std::optional<std::string> takeImportFault();
    void finishReading() { video_.finishReading(); }

private:
    gpu::PictureTexture video_, still_{gpu::Filter::Linear};
    std::optional<std::uint64_t> number_;  // of the frame in video_
    TileBuffer tiles_;
};

[[nodiscard]] std::unique_ptr<StillStep> makeStillStep(const StepSetup& setup, FrameOnGpu& frame);
[[nodiscard]] std::unique_ptr<PyramidStep> makePyramidStep(const StepSetup& setup,
                                                           FrameOnGpu& frame);
[[nodiscard]] std::unique_ptr<FlowStep> makeFlowStep(const StepSetup& setup, FrameOnGpu& frame);
/// `stillRig`: with the still camera as its detail and picture are.
[[nodiscard]] std::unique_ptr<WeighStep>
makeWeighStep(const StepSetup& setup, const StereoRig& stillRig, FrameOnGpu& frame);
[[nodiscard]] std::unique_ptr<DetailStep>
makeDetailStep(const StepSetup& setup, const StereoRig& stillRig, FrameOnGpu& frame);
[[nodiscard]] std::unique_ptr<OcclusionStep> makeOcclusionStep(const StepSetup& setup, Size layer,
                                                               FrameOnGpu& frame);
[[nodiscard]] std::unique_ptr<WarpStep>
makeWarpStep(const StepSetup& setup, const CameraModel& layer, const WarpOptions& options);

}  // namespace mfar::gles
