#pragma once

#include "base/image_view.h"

namespace mfar {

/// Returns true if `crop` is at least as wide and as high as the largest part of the sensor's
/// `active` pixels with the aspect ratio of `output`. The tolerance is 2 %. Returns false if a
/// width or height is not positive.
[[nodiscard]] bool showsWholeField(Size crop, Size active, Size output);

}  // namespace mfar
