// Member functions of Session that pass results on to its Stats.

#include "daemon/session.h"
#include "daemon/thumbnail.h"

#include <stdexcept>

namespace mfar {

void Session::tell(Timestamp time, const FrameStats& frame) {
    tellTracing(time, frame);
    tellLearning();
    if (auto error = drawing_->pipeline.takeSceneError())
        stats_.warn("objects: " + *error, {message::kObjects});
    if (auto error = drawing_->pipeline.takeImportFault())
        stats_.warn(*error + "; pictures of this camera are copied instead");
    stats_.recorderDropped(rig_.notRecorded());
    if (auto matching = rig_.matching()) {
        // StillPolicy repeats the pulses of lost stills, and StillMatcher does not. So the number
        // of repetitions comes from StillPolicy.
        matching->repeated = static_cast<std::uint64_t>(policy_.repetitions());
        stats_.matching(*matching);
    }
}

void Session::tellTracing(Timestamp time, const FrameStats& frame) {
    const auto traced = drawing_->pipeline.tracedCounters();
    if (!traced) return;
    stats_.traced(*traced, time);
    const bool inView = frame.objectsInView && !frame.objectsHidden;
    if (auto warning = drawing_->tracing.add(inView, traced->render, time))
        stats_.warn(*std::move(warning), {message::kObjects});
}

void Session::tellFaultyPasses() {
    for (const gpu::ValidationFault& fault : drawing_->validation->takeFaults()) {
        ++validated_.faults;
        stats_.warn("validation: " + describe(fault));
    }
    validated_.values = 0;
    for (const auto& [pass, count] : drawing_->validation->counts())
        validated_.values += static_cast<std::uint64_t>(count.values);
    stats_.validation(validated_);
    drawing_->validation->nextFrame();
}

// If a picture cannot be read from the GPU, mfard only warns, so that the run still succeeds.
void Session::leavePictures() {
    if (!stats_.keepsHistory()) return;
    RunPictures pictures;
    try {
        if (drawing_->shown) pictures.frame = thumbnail(copyOf(*drawing_->shown).view());
        if (usedStill_) pictures.still = thumbnail(usedStill_->view);
    } catch (const std::runtime_error& error) {
        stats_.warn(std::string("a picture for the report cannot be made: ") + error.what());
    }
    stats_.pictures(std::move(pictures));
}

}  // namespace mfar
