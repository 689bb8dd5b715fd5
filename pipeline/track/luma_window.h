#pragma once

#include "base/image_view.h"
#include "pipeline/track/tag_detector.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// Provides the luma of requested parts of a picture. One thread at a time.
class LumaWindow {
public:
    /// A Gray8 view of the whole picture in which the pixels of `part` (clipped) are valid. It is
    /// the picture's own luma plane where one exists (grey, NV12, YUV420), otherwise a buffer that
    /// is valid until the next call: Y of YUYV, Rec. 601 luma of RGBA and BGRA. Limited range is
    /// not expanded (219/255 of full range's contrast): tag detection depends on contrast, and
    /// corners move by less than 0.02 px.
    [[nodiscard]] ImageView of(const ImageView& picture, const PixelRect& part);

private:
    std::vector<std::uint8_t> buffer_;
};

}  // namespace mfar
