#pragma once

#include "base/image_view.h"

namespace mfar {

/// True when a picture of the shape of `output` cannot show more of the sensor's `active` pixels
/// than `crop` does, to 2 %: cropped only left and right, or only above and below, to get the
/// shape. False when a size is not positive.
[[nodiscard]] bool showsWholeField(Size crop, Size active, Size output);

}  // namespace mfar
