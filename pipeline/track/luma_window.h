#pragma once

#include "base/image_view.h"
#include "pipeline/track/tag_detector.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// Provides the luma of parts of a picture. One thread at a time may use it.
class LumaWindow {
public:
    /// A Gray8 view of the whole picture; pixels are valid only in `part` (clipped to the picture).
    /// If the picture has a luma plane (grey, NV12, YUV420), the view is that plane. Otherwise the
    /// view is a buffer that is valid until the next call: Y of YUYV, Rec. 601 luma of RGBA and
    /// BGRA.
    /// Limited range is not expanded (it has 219/255 of the contrast of full range). Tag detection
    /// depends on contrast, but corners move by less than 0.02 px.
    [[nodiscard]] ImageView of(const ImageView& picture, const PixelRect& part);

private:
    std::vector<std::uint8_t> buffer_;
};

}  // namespace mfar
