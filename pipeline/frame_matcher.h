#pragma once

#include "base/geometry.h"
#include "pipeline/engine/engine.h"
#include "pipeline/enlarge/matched_pictures.h"
#include "pipeline/plan/rgb_planes.h"

#include <memory>

namespace mfar {

/// Matches a video frame with a still. It uses neither the state of the pipeline that processes
/// frames nor predictions from earlier frames. It searches in both dimensions on the CPU, in the
/// caller's thread. Almost all memory is allocated in the constructor and in the first match().
class FrameMatcher {
public:
    explicit FrameMatcher(const StereoRig& rig);

    /// `still` is the luma of a picture of the rig's still camera. `light`: Guidance::light.
    void match(const RgbPlanes& video, Rows<const std::uint8_t> still, float light,
               MatchedPictures& out);

private:
    StereoRig rig_;
    std::unique_ptr<Engine> engine_;
    std::unique_ptr<StillStep> still_;
    std::unique_ptr<PyramidStep> pyramid_;
    std::unique_ptr<FlowStep> flow_;
    std::unique_ptr<WeighStep> weigh_;
    std::uint64_t frames_ = 0;
};

}  // namespace mfar
