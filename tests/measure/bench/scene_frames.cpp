#include "tests/measure/bench/scene_frames.h"

namespace mfar::bench {
namespace {

cv::Mat copyOf(const Frame& frame) {
    const ImageView& view = frame.view();
    return cv::Mat(view.size.height, view.size.width, CV_8UC4, const_cast<std::uint8_t*>(view.data),
                   view.stride)
        .clone();
}

}  // namespace

SceneFrame nextFrame(eval::SceneRun& scene) {
    const auto shots = scene.next();
    SceneFrame out{copyOf(shots.frame), {}, shots.frame.time(), shots.pose, shots.stillPose};
    if (shots.still) out.still = copyOf(*shots.still);
    return out;
}

}  // namespace mfar::bench
