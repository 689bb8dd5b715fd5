#include "base/gl/gl.h"
#include "base/gl/pass.h"
#include "pipeline/gles/gles_steps.h"
#include "pipeline/warp/warp_step.h"

namespace mfar {
namespace {

class GlesEngine final : public Engine {
public:
    explicit GlesEngine(const StepSetup& setup)
        : setup_(setup), stillRig_(stillFor(setup.output, setup.rig)),
          frame_(setup.rig.video.size) {}

    // A frame is matched with up to two stills. Each still has steps of its own. `programs_` lets
    // the steps of both stills use the same compiled programs.
    std::unique_ptr<StillStep> still() override {
        const gpu::ProgramCache::Use use(programs_);
        return gles::makeStillStep(setup_, frame_);
    }
    std::unique_ptr<PyramidStep> pyramid() override {
        const gpu::ProgramCache::Use use(programs_);
        return gles::makePyramidStep(setup_, frame_);
    }
    std::unique_ptr<FlowStep> flow() override {
        const gpu::ProgramCache::Use use(programs_);
        return gles::makeFlowStep(setup_, stillRig_, frame_);
    }
    std::unique_ptr<WeighStep> weigh() override {
        const gpu::ProgramCache::Use use(programs_);
        return gles::makeWeighStep(setup_, stillRig_, frame_);
    }
    std::unique_ptr<DetailStep> detail() override {
        return gles::makeDetailStep(setup_, stillRig_, frame_);
    }
    std::unique_ptr<OcclusionStep> occlusion(Size layer) override {
        return gles::makeOcclusionStep(setup_, layer, frame_);
    }
    std::unique_ptr<WarpStep> warp(const CameraModel& layer, const WarpOptions& options) override {
        return gles::makeWarpStep(setup_, layer, options);
    }

    void flush() override { glFlush(); }
    void finish() override { glFinish(); }
    void finishReading() override { frame_.finishReading(); }
    void setImporter(PlaneImporter* importer) override { frame_.setImporter(importer); }
    std::optional<std::string> takeImportFault() override { return frame_.takeImportFault(); }

private:
    StepSetup setup_;
    StereoRig stillRig_;
    gpu::ProgramCache programs_;
    gles::FrameOnGpu frame_;
};

}  // namespace

std::unique_ptr<Engine> makeGlesEngine(const StepSetup& setup) {
    return std::make_unique<GlesEngine>(setup);
}

}  // namespace mfar
