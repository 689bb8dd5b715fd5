#include "pipeline/frame_matcher.h"

#include "base/workers.h"
#include "pipeline/pipeline.h"

namespace mfar {

FrameMatcher::FrameMatcher(const StereoRig& rig)
    : rig_(rig),
      engine_(makeSimdEngine({rig, Pipeline::fullSize(rig), {}, std::make_shared<Workers>(1)})),
      still_(engine_->still()), pyramid_(engine_->pyramid()), flow_(engine_->flow()),
      weigh_(engine_->weigh()) {}

void FrameMatcher::match(const RgbPlanes& video, Rows<const std::uint8_t> still, float light,
                         MatchedPictures& out) {
    const ImageView view{still.data, still.size, static_cast<std::size_t>(still.pitch),
                         PixelFormat::Gray8};
    const StillPictures& pictures = still_->run(view, SuperResMode::Detail, {}, 0);
    pyramid_->still(pictures, light);
    const TileWork work = TileWork::everything(tilesOf(rig_.video.size));
    const VideoFrame frame{view, video, ++frames_};  // the steps read only the planes, not the view
    const LumaPyramid& luma = pyramid_->video(frame, work);
    const CellWeights& weights =
        weigh_->run(luma, flow_->run({frame, pictures, light}, luma, work, false), work);
    const CameraModel& looked = pictures.rig.still;
    out.take(video, pictures.luma.host(), weights.lookUps.host(),
             {looked.size, looked.fx / rig_.video.fx, looked.fy / rig_.video.fy});
}

}  // namespace mfar
