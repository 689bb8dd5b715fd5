#pragma once

#include "base/image_view.h"

#include <opencv2/core.hpp>

namespace mfar {

/// Converts a valid picture (requireSound()) of any format to channels B, G, R, or to one channel
/// if it is grey. Chroma is interpolated as in picture_from_yuv.frag, so that a recording has the
/// same pixels that the pipeline used. A grey result shares the picture's memory.
[[nodiscard]] cv::Mat bgrPicture(const ImageView& picture);

}  // namespace mfar
