#include "daemon/rig_cameras.h"

#include "daemon/budgets.h"
#include "daemon/config.h"
#include "daemon/rig_trigger.h"
#include "daemon/taken_line.h"
#include "hal/device/camera_libcamera.h"
#include "hal/device/camera_v4l2.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace mfar {
namespace {

constexpr double kNominalView = std::numbers::pi / 3;  // [rad]
constexpr double kNominalBaseline = 0.014;             // [m]
// After kSilentPeriods frame periods without a frame, but not earlier than
// ReopeningOptions::silent, a camera is reported as silent. After kStalledPeriods, but not earlier
// than ReopeningOptions::stalled, it is reopened.
constexpr double kSilentPeriods = 4.5, kStalledPeriods = 20;
constexpr double kUnknownPeriodMs = 500;

/// A trigger whose GPIO line may not exist yet. If the line is not open, each fire() tries to open
/// it, and between pulses, rest() tries to open it once a second.
class WaitingTrigger final : public Trigger {
public:
    explicit WaitingTrigger(const TriggerLineConfig& line)
        : line_(line), options_(triggerOptions(line)) {}

    Timestamp fire() override {
        const std::lock_guard lock(mutex_);
        try {
            open();
            const Timestamp edge = open_->fire();
            fault_.reset();
            return edge;
        } catch (const TriggerBusy&) {
            throw;
        } catch (const std::runtime_error& error) {
            if (open_) missedBefore_ += open_->missedEdges();
            open_.reset();
            // So rest() does not open the line, and clear the fault, before the fault was read.
            tried_ = Timestamp::now();
            fault_ = "trigger: " + std::string(error.what());
            throw;
        }
    }
    void rest() override {
        const std::lock_guard lock(mutex_);
        const Timestamp now = Timestamp::now();
        if (open_ || (tried_ && now - *tried_ < std::chrono::seconds(1))) return;
        try {
            open();
            fault_.reset();
        } catch (const std::runtime_error& error) {
            fault_ = "trigger: " + std::string(error.what());
        }
    }
    void endPulse() override {
        const std::lock_guard lock(mutex_);
        if (open_) open_->endPulse();
    }
    [[nodiscard]] std::uint64_t missedEdges() const override {
        const std::lock_guard lock(mutex_);
        return missedBefore_ + (open_ ? open_->missedEdges() : 0);
    }
    [[nodiscard]] std::string name() const override {
        return fmt::format("trigger line {}", options_.line);
    }
    [[nodiscard]] std::optional<std::string> fault() const {
        const std::lock_guard lock(mutex_);
        return fault_;
    }

private:
    /// Opens the line if it is not open. The caller must have locked mutex_. Throws
    /// std::runtime_error.
    void open() {
        if (open_) return;
        tried_ = Timestamp::now();
        // The line's name is written to a file before the line is opened. So after a crash, the
        // program release-trigger always finds in the file which line to release.
        if (const auto file = takenLineFile(); !file.empty()) noteTakenLine(file, line_);
        open_ = openGpioTrigger(options_);
    }

    const TriggerLineConfig line_;
    const TriggerOptions options_;
    mutable std::mutex mutex_;
    std::unique_ptr<PulseTrigger> open_;
    std::uint64_t missedBefore_ = 0;
    std::optional<Timestamp> tried_;
    std::optional<std::string> fault_;
};

/// Returns which camera to open for a sensor. If none is configured, this is any camera except the
/// one configured for the other sensor.
CameraWish wishFor(const CameraConfig& config, const CameraConfig& other, bool largest) {
    const bool shares = config.driver == other.driver;
    return {config.camera, shares ? other.camera : "", largest, shares};
}

std::unique_ptr<Camera> openCamera(const CameraConfig& config, const CameraWish& wish) {
    const bool onTrigger = config.rateHz == 0;
    if (config.driver == CameraDriver::V4l2) {
        CameraV4l2Options options;
        options.device = wish;
        options.wish.size = config.size;
        if (!onTrigger) options.wish.rateHz = config.rateHz;
        if (config.format != "auto") options.wish.format = config.format;
        options.controls = config.controls;
        return std::make_unique<CameraV4l2>(options);
    }
    LibcameraOptions options;
    options.camera = wish;
    options.size = config.size;
    options.rateHz = config.rateHz;
    options.controls = config.controls;
    options.still = onTrigger;
    options.allowCrop = config.allowCrop;
    return std::make_unique<LibcameraCamera>(options);
}

std::string chosenCamera(CameraDriver driver, const CameraWish& wish) {
    return driver == CameraDriver::V4l2 ? chosenV4l2(wish) : chosenLibcamera(wish);
}

std::unique_ptr<ReopeningCamera> waitingCamera(const CameraConfig& config,
                                               ReopeningCamera::Open open, const std::string& role,
                                               WatchedThread opener, bool onTrigger,
                                               std::function<bool()> busyElsewhere) {
    ReopeningOptions options;
    options.opener = std::move(opener);
    if (config.driver == CameraDriver::Libcamera) options.busyElsewhere = std::move(busyElsewhere);
    const double periodMs = config.rateHz > 0 ? 1e3 / config.rateHz : kUnknownPeriodMs;
    const auto periods = [&](double count) {
        return std::chrono::milliseconds(std::lround(count * periodMs));
    };
    // A triggered camera sends no frames without pulses, so it never counts as silent.
    options.silent = onTrigger ? std::chrono::milliseconds(0)
                               : std::max(options.silent, periods(kSilentPeriods));
    if (!onTrigger) options.stalled = std::max(options.stalled, periods(kStalledPeriods));
    return std::make_unique<ReopeningCamera>(
        CameraInfo{role, config.size, PixelFormat::Nv12, config.rateHz}, std::move(open), options);
}

CameraModel nominalCamera(Size size) {
    const double f = size.width / (2 * std::tan(kNominalView / 2));
    return {size, f, f, (size.width - 1) / 2.0, (size.height - 1) / 2.0, {}};
}

}  // namespace

StereoRig nominalRig(Size video, Size still) {
    StereoRig rig{nominalCamera(video), nominalCamera(still), {}};
    rig.T_still_video.translation.x() = -kNominalBaseline;
    return rig;
}

RigCalibration calibrationOf(const CamerasConfig& config) {
    if (config.calibration.empty()) return {nominalRig(config.video.size, config.still.size), 0};
    std::error_code ignored;
    const bool there = std::filesystem::exists(config.calibration, ignored);
    return orFail<CalibrationError>(there ? ExitCode::BadData : ExitCode::NoInput, [&] {
        return loadRig(config.calibration, {config.video.size, config.still.size});
    });
}

CamerasSource::CamerasSource(const CamerasConfig& config, Heartbeats& hearts)
    : config_(config),
      video_(waitingCamera(
          config.video, [this] { return openVideo(); }, "video camera",
          {&hearts, "video camera opener", budget::kOpener, ThreadRole::Vital}, false,
          [this] { return config_.still.driver == CameraDriver::Libcamera && still_->absent(); })) {
    const RigCalibration calibration = calibrationOf(config);
    hasSensors = true;
    geometry_ = calibration.rig;
    stillTimeOffset = std::chrono::nanoseconds(std::llround(1e9 * calibration.stillTimeOffset));
    auto still = waitingCamera(
        config.still, [this] { return openStill(); }, "still camera",
        {&hearts, "still camera opener", budget::kOpener, ThreadRole::Helper},
        config.still.rateHz == 0 && !config.trigger.line.empty(),
        [this] { return config_.video.driver == CameraDriver::Libcamera && video_->absent(); });
    still_ = still.get();
    if (config.trigger.line.empty()) {
        freeStill_ = std::move(still);
    } else {
        auto line = std::make_unique<WaitingTrigger>(config.trigger);
        triggerFault_ = [waiting = line.get()] { return waiting->fault(); };
        triggered_ = std::make_unique<TriggeredStillCamera>(std::move(still), std::move(line),
                                                            stillOptions(config.trigger));
        matching = [this] { return triggered_->counters(); };
    }
    fault = [this] { return whatIsWrong(); };
}

bool CamerasSource::choosesBoth() const {
    return config_.video.camera.empty() && config_.still.camera.empty() &&
           config_.video.driver == config_.still.driver;
}

std::unique_ptr<Camera> CamerasSource::openVideo() {
    auto camera = openCamera(config_.video, wishFor(config_.video, config_.still, false));
    const std::lock_guard lock(mutex_);
    videoName_ = camera->info().name;
    return camera;
}

// If the camera with the larger pictures is connected first, it is used for the video. When the
// other camera is connected, the video changes to that one and leaves the larger one to the stills.
std::unique_ptr<Camera> CamerasSource::openStill() {
    if (choosesBoth() && !video_->absent()) {
        const std::string smallest =
            chosenCamera(config_.video.driver, wishFor(config_.video, config_.still, false));
        const std::lock_guard lock(mutex_);
        if (videoName_ != smallest)
            video_->reopen("a camera with smaller pictures was connected and is used instead");
    }
    return openCamera(config_.still, wishFor(config_.still, config_.video, true));
}

Camera& CamerasSource::still() {
    if (triggered_) return *triggered_;
    return *freeStill_;
}

std::string CamerasSource::name() const {
    return config_.calibration.empty() ? "cameras, not calibrated" : "cameras";
}

std::optional<std::string> CamerasSource::whatIsWrong() const {
    std::string all;
    for (const auto& one :
         {video_->fault(), still_->fault(), triggerFault_ ? triggerFault_() : std::nullopt})
        if (one) all += (all.empty() ? "" : "\n") + *one;
    if (all.empty()) return std::nullopt;
    return all;
}

}  // namespace mfar
