#pragma once

#include "base/image_view.h"

namespace mfar {

/// Returns whether `crop` shows as much of the sensor's `active` pixels as possible with the aspect
/// ratio of `output`. Such a crop removes pixels only left and right, or only above and below. The
/// tolerance is 2 %. Returns false if a width or height is not positive.
[[nodiscard]] bool showsWholeField(Size crop, Size active, Size output);

}  // namespace mfar
