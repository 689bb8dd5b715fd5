#include "tests/demo/still_feed.h"

#include "tests/measure/eval/picture.h"

#include <optional>

namespace mfar::demo {

void StillFeed::feed(Pipeline& pipeline, Timestamp frame) {
    const std::size_t before = next_;
    while (next_ < recording_.stills.size() && recording_.stills[next_].time < frame)
        ++next_;
    if (next_ == before) return;
    const RecordedImage& still = recording_.stills[next_ - 1];
    const cv::Mat rgba = eval::toRgba(eval::loadPicture(still.file));
    pipeline.setStill(eval::viewOf(rgba), still.time,
                      poses_ ? poses_->of(frame, still.time).still : std::nullopt);
}

}  // namespace mfar::demo
