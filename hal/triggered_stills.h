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
    /// Exposure of all stills, whatever the camera reports. 0: the exposure that the camera
    /// reports. For a sensor that exposes as long as the pulse lasts, set it to the length of the
    /// pulse: such a sensor ignores its own setting, but the driver still reports it.
    std::chrono::nanoseconds exposure{0};
};

/// Combines the still camera and its trigger. Delivers only stills that match a pulse, in the order
/// of their times. If a still does not arrive, its pulse is repeated once, unless
/// StillMatcherOptions::repeat is false. fire(), stop() and counters() are thread-safe.
///
/// A still's time is the time of its pulse + the learned delay + half the exposure. The delay is a
/// median over StillMatcherOptions::learnFrom stills, which removes the jitter of the camera's
/// timestamps.
class TriggeredStillCamera final : public Camera, public Trigger {
public:
    TriggeredStillCamera(std::unique_ptr<Camera> camera, std::unique_ptr<Trigger> trigger,
                         const TriggeredStillOptions& options);

    [[nodiscard]] CameraInfo info() const override;
    void start() override;
    /// Returns the next still. Also repeats lost pulses, so it must be called regularly. Throws the
    /// errors of the camera and, when a pulse is repeated, those of the trigger except TriggerBusy.
    [[nodiscard]] std::optional<Frame> next(std::chrono::milliseconds timeout) override;
    /// Ends an active pulse, then stops the camera. Until the next start(), fire() throws
    /// TriggerBusy.
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

    /// Guards the members below. It stays locked from firing a pulse until the pulse is registered,
    /// so that the pulse's still cannot be matched earlier.
    mutable std::mutex mutex_;
    StillMatcher matcher_;
    std::optional<Timestamp> newest_;
    std::uint64_t overtaken_ = 0;
};

}  // namespace mfar
