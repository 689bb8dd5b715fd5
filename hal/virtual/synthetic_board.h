#pragma once

#include "base/geometry.h"
#include "hal/camera.h"
#include "hal/trigger.h"
#include "hal/virtual/image_files.h"
#include "hal/virtual/recording_player.h"
#include "hal/virtual/synthetic_scene.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>

namespace mfar {

struct SyntheticOptions {
    synthetic::Scene scene = synthetic::Scene::Office;
    /// Path along which the camera moves. Not set: Path::Rest for Scene::Still, Path::Survey for
    /// Scene::Calibration, and Path::Handheld for all other scenes.
    std::optional<synthetic::Path> path{};
    std::uint64_t seed = 1;
    Pace pace = Pace::Realtime;
    int frames = 0;  ///< 0: unlimited
    double rateHz = 30;
    double noise = 1;  ///< factor of the standard deviation of both sensors' noise
    /// Lenses, picture sizes and relative position of the two sensors. Not set:
    /// synthetic::boardRig(). The time to render a picture grows with the number of its pixels.
    std::optional<StereoRig> rig{};
    /// Number of buffers for pictures that are in use or ready.
    int videoBuffers = 8;
    int stillBuffers = 4;
    /// stillDelay is the time from a trigger pulse to the start of the exposure, stillLatency the
    /// time from the pulse to the delivery of the still.
    std::chrono::nanoseconds stillDelay = std::chrono::milliseconds(1);
    std::chrono::nanoseconds stillExposure = std::chrono::milliseconds(8);
    std::chrono::nanoseconds stillLatency = std::chrono::milliseconds(60);
};

class SyntheticStudio;

/// A simulated board with a video camera of 640x480 pixels and, 14 mm from it, a triggered still
/// camera of 2304x1728 pixels (unless SyntheticOptions::rig differs). Each has its own lens, gain,
/// gamma, blur and noise, but no motion blur and no rolling shutter. They see a generated world
/// with exact ground truth at any time.
///
/// Pace::Realtime: the clock is Timestamp::now(), and frames come at rateHz. If the renderer or the
/// consumer is too slow, frames are skipped. Stills are rendered in steps between video frames. The
/// same options give the same picture at the same time after epoch().
///
/// Pace::Consumer: a frame is delivered as soon as it is requested; none is skipped. The same
/// options and pulses give the same bytes. The current time is the time of the last frame that
/// video().next() returned, or epoch() before the first frame. A pulse is fired at the current
/// time. Its still is available when the current time is at least stillLatency after the pulse.
/// After the end of the video, stills().next() with a timeout above zero returns the remaining
/// stills. video().next() waits for the renderer without a limit. Its timeout applies only while
/// the consumer holds all buffers.
///
/// As with a real sensor, a pulse is lost if the previous exposure has not ended, if
/// stillBuffers - 1 stills are pending, or if the still camera is not started.
///
/// The program must link a definition of createGlContext(), because the board's thread has its own
/// GL context. The cameras and the trigger live as long as the board; frames may outlive it. All
/// functions are thread-safe.
class SyntheticBoard {
public:
    enum class View {
        Video,
        Still,
        /// From the position of the still camera, with the orientation, lens and resolution of the
        /// video camera.
        StillAtVideo,
    };

    explicit SyntheticBoard(const SyntheticOptions& options);
    ~SyntheticBoard();
    SyntheticBoard(const SyntheticBoard&) = delete;
    SyntheticBoard& operator=(const SyntheticBoard&) = delete;

    [[nodiscard]] const StereoRig& rig() const { return rig_; }
    [[nodiscard]] const synthetic::World& world() const { return world_; }
    [[nodiscard]] Camera& video() { return *video_; }
    [[nodiscard]] Camera& stills() { return *stills_; }
    [[nodiscard]] Trigger& trigger() { return *trigger_; }
    /// Returns the time at which the world's time is 0. The world is also defined at earlier times.
    [[nodiscard]] Timestamp epoch() const;

    [[nodiscard]] Pose pose(Timestamp t) const;
    /// Returns the inverse depth 1 / z [1/m] of each video pixel; 0: background.
    [[nodiscard]] FloatImage inverseDepth(Timestamp t) const;
    /// Returns, for each pixel of `from`, the offset [px] to the same point in `to`. NaN: the pixel
    /// shows the background, or the point is occluded in `to` or outside of that picture.
    [[nodiscard]] FlowImage flow(View from, Timestamp fromTime, View to, Timestamp toTime) const;
    /// Returns the picture of the video camera at the still's resolution: same lens, gain and
    /// gamma, without noise and blur. Takes as long as rendering a still.
    [[nodiscard]] StoredImage highRes(Timestamp t);
    [[nodiscard]] StoredImage cleanVideo(Timestamp t);

private:
    StereoRig rig_;
    synthetic::World world_;
    std::unique_ptr<SyntheticStudio> studio_;
    std::unique_ptr<Camera> video_, stills_;
    std::unique_ptr<Trigger> trigger_;
};

}  // namespace mfar
