#pragma once

#include "base/image_view.h"
#include "pipeline/track/tag_detector.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// Provides the luma of parts of a picture. Only one thread at a time may use it.
class LumaWindow {
public:
    /// Returns a Gray8 view of the whole picture. Only its pixels in `part` are valid; `part` is
    /// clipped to the picture. If the picture has a luma plane (grey, NV12, YUV420), the view is
    /// this plane. Otherwise, it is a buffer that is valid until the next call. The buffer contains
    /// the Y of YUYV, or the Rec. 601 luma of RGBA and BGRA.
    ///
    /// Luma of limited range is not expanded to full range. Its contrast is 219/255 of that of full
    /// range, which moves the detected corners by less than 0.02 px.
    [[nodiscard]] ImageView of(const ImageView& picture, const PixelRect& part);

private:
    std::vector<std::uint8_t> buffer_;
};

}  // namespace mfar
