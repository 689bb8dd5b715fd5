#pragma once

#include "base/image_view.h"

namespace mfar {

/// Returns whether `crop` is the largest part of the sensor's `active` pixels that has the aspect
/// ratio of `output`, with a tolerance of 2 %. Such a crop removes pixels only left and right, or
/// only above and below. Returns false if a width or height is not positive.
[[nodiscard]] bool showsWholeField(Size crop, Size active, Size output);

}  // namespace mfar
