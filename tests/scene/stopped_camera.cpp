#include "tests/scene/stopped_camera.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace mfar::test {

StoppedCamera::StoppedCamera(SyntheticBoard& board, const Frame& last)
    : clean_(board.cleanVideo(last.time())), shown_(clean_) {
    const ImageView& view = last.view();
    assert(view.size == clean_.size && view.format == clean_.format);
    const auto row = static_cast<std::size_t>(view.size.width) * bytesPerPixel(view.format);
    for (std::size_t i = 0; i < clean_.pixels.size(); ++i)
        noise_.push_back(view.data[i / row * view.stride + i % row] - clean_.pixels[i]);
}

ImageView StoppedCamera::next() {
    constexpr std::size_t kReach = 17;  // prime, so steps of 5 and 7 reach all shifts of 0 to 16 px
    ++moves_;
    const std::size_t dx = 5 * moves_ % kReach, dy = 7 * (moves_ / kReach) % kReach;
    const std::size_t shift = (dy * clean_.size.width + dx) * bytesPerPixel(clean_.format);
    for (std::size_t i = 0; i < noise_.size(); ++i)
        shown_.pixels[i] = static_cast<std::uint8_t>(
            std::clamp(clean_.pixels[i] + noise_[(i + shift) % noise_.size()], 0, 255));
    return shown_.view();
}

}  // namespace mfar::test
