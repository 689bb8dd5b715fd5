#pragma once

#include "pipeline/pipeline.h"
#include "tests/engine/pictures.h"

namespace mfar {

/// A pattern with finer detail than the video resolves, seen by two cameras without distortion. Its
/// unit is a video pixel. The still's pixels are 3.6 times finer.
struct PipelineCase {
    explicit PipelineCase(Size video = {160, 120})
        : rig(plainRig(video, {video.width * 18 / 5, video.height * 18 / 5})) {}

    [[nodiscard]] TestPicture video(const Eigen::Vector2d& shift = {0, 0}) const {
        return waves.shoot(rig.video.size, {.shift = shift});
    }
    [[nodiscard]] TestPicture still() const { return fine(rig.still.size, {0, 0}); }
    [[nodiscard]] TestPicture fine(Size size, const Eigen::Vector2d& shift) const {
        const double step = static_cast<double>(rig.video.size.width) / size.width;
        return waves.shoot(size, {.step = step, .shift = shift, .footprint = step});
    }

    StereoRig rig;
    Waves waves{1, 1.2, 60, 40, 96};
};

}  // namespace mfar
