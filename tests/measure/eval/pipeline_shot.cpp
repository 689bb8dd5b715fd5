#include "tests/measure/eval/pipeline_shot.h"

#include "tests/measure/eval/picture.h"

namespace mfar::eval {

PipelineShot::PipelineShot(const Shot& shot, bool usePose)
    : rgba_(toRgba(shot.picture)), time_(shot.time), pose_(usePose ? shot.pose : std::nullopt) {}

void PipelineShot::giveAsStill(Pipeline& pipeline) const {
    pipeline.setStill(viewOf(rgba_), time_, pose_);
}

const FrameResult& PipelineShot::run(Pipeline& pipeline) const {
    return pipeline.run(viewOf(rgba_), time_, pose_);
}

}  // namespace mfar::eval
