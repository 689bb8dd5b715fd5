#pragma once

#include "pipeline/render/rendered_picture.h"

#include <opencv2/core.hpp>

#include <vector>

namespace mfar::eval {

/// A picture, and the poses T_world_object of the objects that it shows, see posesAt().
struct PosedPicture {
    const RenderedPicture& picture;
    std::vector<RigidTransform> poses;
};

/// Flow of the objects' pixels from the picture `now` to the picture `before`, CV_32FC2 [px]. NaN
/// where `before` does not show the same object.
[[nodiscard]] cv::Mat motionTo(const PosedPicture& before, const PosedPicture& now);

}  // namespace mfar::eval
