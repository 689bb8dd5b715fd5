#pragma once

#include "hal/frame.h"
#include "pipeline/track/tag_detector.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// Luma of the parts of a picture that are looked at. One thread at a time.
class LumaWindow {
public:
    /// A Gray8 view of the whole picture in which the pixels of `part` (clipped) are valid: the
    /// picture itself, or a buffer that lives until the next call. Rec. 601 weights.
    [[nodiscard]] ImageView of(const ImageView& picture, const PixelRect& part);

private:
    std::vector<std::uint8_t> buffer_;
};

}  // namespace mfar
