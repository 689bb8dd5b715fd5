#pragma once

#include "base/image_view.h"
#include "pipeline/track/tag_detector.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// Provides the luma of parts of a picture. One thread at a time may use it.
class LumaWindow {
public:
    /// Returns a Gray8 view of the whole picture. Its pixels are valid only in `part` (clipped to
    /// the picture). If the picture has a luma plane (grey, NV12, YUV420), the view is that plane.
    /// Otherwise the view is a buffer that is valid until the next call: Y of YUYV, Rec. 601 luma
    /// of RGBA and BGRA.
    /// Luma of limited range is not expanded to full range, of which it has 219/255 of the
    /// contrast. Tag detection depends on contrast, but the corners move by less than 0.02 px.
    [[nodiscard]] ImageView of(const ImageView& picture, const PixelRect& part);

private:
    std::vector<std::uint8_t> buffer_;
};

}  // namespace mfar
