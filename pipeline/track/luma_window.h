#pragma once

#include "base/image_view.h"
#include "pipeline/track/tag_detector.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// Luma of the parts of a picture that are looked at. One thread at a time.
class LumaWindow {
public:
    /// A Gray8 view of the whole picture in which the pixels of `part` (clipped) are valid: the
    /// picture's own luma where that is a plane (grey, NV12, YUV420), otherwise a buffer that lives
    /// until the next call: Y of YUYV, Rec. 601 luma of RGBA and BGRA. Limited range stays as it is
    /// (219/255 of full range's contrast): tag detection looks at contrast, and corners move by
    /// less than 0.02 px.
    [[nodiscard]] ImageView of(const ImageView& picture, const PixelRect& part);

private:
    std::vector<std::uint8_t> buffer_;
};

}  // namespace mfar
