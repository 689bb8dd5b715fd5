#pragma once

#include "pipeline/pipeline.h"
#include "tests/engine/pictures.h"

namespace mfar {

/// A pattern with detail beyond the video's resolution, seen by two ideal cameras. Its unit is a
/// video pixel; the still is 3.6 times as fine.
struct PipelineCase {
    explicit PipelineCase(Size video = {160, 120})
        : rig(plainRig(video, {video.width * 18 / 5, video.height * 18 / 5})) {}

    /// What the video sees after moving by `shift`: each pixel averages its area.
    [[nodiscard]] TestPicture video(const Eigen::Vector2d& shift = {0, 0}) const {
        return waves.shoot(rig.video.size, {.shift = shift});
    }
    [[nodiscard]] TestPicture still() const { return fine(rig.still.size, {0, 0}); }
    /// The video's view at another resolution.
    [[nodiscard]] TestPicture fine(Size size, const Eigen::Vector2d& shift) const {
        const double step = static_cast<double>(rig.video.size.width) / size.width;
        return waves.shoot(size, {.step = step, .shift = shift, .footprint = step});
    }

    StereoRig rig;
    Waves waves{1, 1.2, 60, 40, 96};
};

}  // namespace mfar
