#pragma once

#include "base/image_view.h"

#include <opencv2/core.hpp>

namespace mfar {

/// Converts a picture of any format to channels B, G, R. A grey picture keeps one channel, and the
/// result shares its memory. Chroma is interpolated like in picture_from_yuv.frag, so that a
/// recording has the same pixels that the pipeline used. The picture must pass requireSound().
[[nodiscard]] cv::Mat bgrPicture(const ImageView& picture);

}  // namespace mfar
