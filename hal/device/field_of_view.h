#pragma once

#include "base/image_view.h"

namespace mfar {

/// True when a part `crop` of the pixels `active` of a sensor is all that a picture with the shape
/// of `output` can show of it, to 2 %: cropped at most left and right, or above and below, to get
/// the shape. False when a size is not positive.
[[nodiscard]] bool showsWholeField(Size crop, Size active, Size output);

}  // namespace mfar
