#pragma once

#include "hal/camera.h"
#include "hal/still_matcher.h"
#include "hal/trigger.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace mfar {

struct TriggeredStillOptions {
    StillMatcherOptions matching;
    /// Exposure of stills for which the camera does not report it: the pulse length, if that sets
    /// the exposure. 0: unknown.
    std::chrono::nanoseconds exposure{0};
};

/// Combines the still camera and its trigger: delivers only stills that match a pulse, each once
/// and in the order of their times, and fires again once for a pulse without a still.
///
/// A still's time is its pulse + the learned constant + half the exposure. The constant is the
/// median over twenty of the camera's times, which removes their jitter; the pulse is timed to
/// microseconds. `fire` and `counters` may be called from any thread.
class TriggeredStillCamera final : public Camera, public Trigger {
public:
    /// Throws std::invalid_argument, see StillMatcher.
    TriggeredStillCamera(std::unique_ptr<Camera> camera, std::unique_ptr<Trigger> trigger,
                         const TriggeredStillOptions& options);

    /// The camera's info with rate 0.
    [[nodiscard]] CameraInfo info() const override;
    void start() override;
    /// Throws what the camera throws, and what the trigger throws for a repetition. Also finds and
    /// repeats lost pulses, so it must be called regularly, e.g. with timeout 0.
    [[nodiscard]] std::optional<Frame> next(std::chrono::milliseconds timeout) override;
    /// Stops both: the line becomes inactive first, and fire() throws TriggerBusy until start().
    void stop() override;
    [[nodiscard]] bool ended() const override { return camera_->ended(); }

    Timestamp fire() override;
    void rest() override { trigger_->rest(); }
    void endPulse() override { trigger_->endPulse(); }
    [[nodiscard]] std::string name() const override { return trigger_->name(); }

    [[nodiscard]] StillCounters counters() const;
    [[nodiscard]] CameraCounters cameraCounters() const override {
        return camera_->cameraCounters();
    }
    [[nodiscard]] std::vector<std::string> takeWarnings() override {
        return camera_->takeWarnings();
    }
    [[nodiscard]] std::uint64_t missedEdges() const override { return trigger_->missedEdges(); }

private:
    void repeatLost();
    [[nodiscard]] std::optional<Frame> admit(Frame frame);

    std::unique_ptr<Camera> camera_;
    std::unique_ptr<Trigger> trigger_;
    std::chrono::nanoseconds exposure_;
    std::atomic<bool> stopped_{false};

    mutable std::mutex
        mutex_;  ///< also keeps a still from being matched before its pulse is registered
    StillMatcher matcher_;
    std::optional<Timestamp> newest_;
    std::uint64_t overtaken_ = 0;
};

}  // namespace mfar
