#pragma once

#include "base/image_view.h"

#include <opencv2/core.hpp>

namespace mfar {

/// Converts a valid picture (requireSound()) of any format for OpenCV's file writers: B G R, or one
/// channel if grey. Chroma is interpolated as in picture_from_yuv.frag, so that a recording shows
/// what the pipeline saw. A grey result shares the picture's memory.
[[nodiscard]] cv::Mat bgrPicture(const ImageView& picture);

}  // namespace mfar
