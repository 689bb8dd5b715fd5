#pragma once

#include "base/image_view.h"

#include <opencv2/core.hpp>

namespace mfar {

/// A sound picture (requireSound()) of any format as OpenCV writes it to files: B G R, or one
/// channel of a grey one. Chroma is interpolated as picture_from_yuv.frag does it, so that a
/// recording shows what the pipeline saw. A grey one is the picture's own memory.
[[nodiscard]] cv::Mat bgrPicture(const ImageView& picture);

}  // namespace mfar
