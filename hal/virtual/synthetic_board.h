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
    /// Empty: at rest in `still`, survey in `calibration`, hand-held in the others.
    std::optional<synthetic::Path> path{};
    std::uint64_t seed = 1;
    Pace pace = Pace::Realtime;
    int frames = 0;        ///< video frames until the camera ends, 0: unlimited
    double rateHz = 30;    ///< of the video camera
    double noise = 1;      ///< scales the standard deviation of both sensors' noise
    int videoBuffers = 8;  ///< frames that exist at once, lent or waiting
    int stillBuffers = 4;
    std::chrono::nanoseconds stillDelay = std::chrono::milliseconds(1);  ///< pulse to exposure
    std::chrono::nanoseconds stillExposure = std::chrono::milliseconds(8);
    std::chrono::nanoseconds stillLatency = std::chrono::milliseconds(60);  ///< pulse to picture
};

class SyntheticStudio;

/// A dual-sensor board in a generated world: 640x480 video, 2304x1728 stills on trigger, 14 mm
/// apart, each with its own lens, gain, gamma, blur and noise. The world exists for any time and
/// provides ground truth. The same options and pulses give the same bytes (Pace::Consumer) or the
/// same pictures for the same times (Pace::Realtime, whose clock is Timestamp::now()). There is no
/// motion blur: the world stands still during an exposure; the shutter is global.
///
/// Pace::Realtime: frames at rateHz; frames for which the renderer or the consumer is too slow are
/// skipped. Stills are rendered in steps between video frames.
///
/// Pace::Consumer: a frame is delivered as soon as it is requested; none is skipped. The current
/// time is that of the last frame that video().next() returned (the epoch before the first): a
/// pulse is fired at that time, and its still is available when a video frame at least stillLatency
/// later has been returned, or, for a next() with a timeout above zero, when the video has ended.
/// next() waits for the renderer regardless of its timeout; the timeout applies while the consumer
/// holds all buffers, and to stills.
///
/// A pulse is lost, as on a real sensor, during the last exposure, while stillBuffers - 1 stills
/// are pending, and while the still camera is not started.
///
/// Needs a linked createGlContext(); its thread has its own context. The cameras and the trigger
/// live as long as the board; frames may outlive it. All functions are thread-safe.
class SyntheticBoard {
public:
    /// The picture plane of ground truth.
    enum class View {
        Video,         ///< the video sensor
        Still,         ///< the still sensor
        StillAtVideo,  ///< the still's position with the video's orientation, lens and resolution
    };

    /// Throws std::runtime_error when there is no GL context.
    explicit SyntheticBoard(const SyntheticOptions& options);
    ~SyntheticBoard();
    SyntheticBoard(const SyntheticBoard&) = delete;
    SyntheticBoard& operator=(const SyntheticBoard&) = delete;

    [[nodiscard]] const StereoRig& rig() const { return rig_; }
    [[nodiscard]] const synthetic::World& world() const { return world_; }
    [[nodiscard]] Camera& video() { return *video_; }
    [[nodiscard]] Camera& stills() { return *stills_; }
    [[nodiscard]] Trigger& trigger() { return *trigger_; }
    /// Start time of the world, which exists before, too.
    [[nodiscard]] Timestamp epoch() const;

    /// Exact pose of the video camera.
    [[nodiscard]] Pose pose(Timestamp t) const;
    /// 1 / z [1/m] per video pixel; 0 = background.
    [[nodiscard]] FloatImage inverseDepth(Timestamp t) const;
    /// Offset [px] from each pixel of one view to the same point in another; NaN = occluded or
    /// outside there.
    [[nodiscard]] FlowImage flow(View from, Timestamp fromTime, View to, Timestamp toTime) const;
    /// The video sensor's view at the still's resolution: same lens, gain and gamma, no noise and
    /// no blur. Takes as long as a still.
    [[nodiscard]] StoredImage highRes(Timestamp t);
    /// The video frame without its noise.
    [[nodiscard]] StoredImage cleanVideo(Timestamp t);

private:
    StereoRig rig_;
    synthetic::World world_;
    std::unique_ptr<SyntheticStudio> studio_;
    std::unique_ptr<Camera> video_, stills_;
    std::unique_ptr<Trigger> trigger_;
};

}  // namespace mfar
