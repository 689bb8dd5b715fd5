#pragma once

#include "daemon/call_queue.h"
#include "daemon/capture.h"
#include "daemon/config.h"
#include "daemon/drawing.h"
#include "daemon/governor.h"
#include "daemon/gpu_failures.h"
#include "daemon/mailbox.h"
#include "daemon/pose_finder.h"
#include "daemon/rig.h"
#include "daemon/session_engines.h"
#include "daemon/stats.h"
#include "daemon/status.h"
#include "daemon/still_policy.h"
#include "daemon/trigger_reports.h"
#include "hal/display.h"
#include "hal/gl_context.h"

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace mfar {

class FilterLearning;

/// The settings that can change while mfard runs.
struct Tunables {
    SuperResConfig superres;
    TriggerConfig trigger;
    bool measure = false;
    std::vector<PlacedObject> objects{};
    LightOptions light{};
};

[[nodiscard]] inline Tunables tunables(const Config& config) {
    return {config.superres, config.trigger, config.status.measure, config.objects, config.light};
}

/// Two ways in which other threads can end a session.
struct StopTokens {
    std::stop_token
        input;  ///< fetch no more frames; processed pictures are still shown and written
    std::stop_token cancel;  ///< do not wait for a slow display any more
};

/// One run, from the devices to the display. It owns all objects of the GL thread. The GL thread
/// creates, runs and destroys it.
class Session {
public:
    /// Opens devices, GL and display. All references must outlive this object. Throws Failure.
    Session(const Config& config, Stats& stats, Mailbox<Tunables>& changes,
            CallQueue<Session>& calls, StopTokens stop);
    ~Session();

    [[nodiscard]] const RunDescription& description() const { return description_; }
    /// Returns the line that is logged at the start: renderer, sensors, display, output size.
    [[nodiscard]] std::string startLine() const;

    /// A function that is called with the reason why the pictures ended, or with the error.
    using Over = std::function<void(const std::string& reason, const std::exception_ptr& error)>;
    /// Processes frames until the source ends, a stop is requested or `maxFrames` are shown. Waits
    /// until they are written, then calls `over`. After that, only the devices must be closed,
    /// which may hang. Returns the reason of the end. Throws Failure.
    [[nodiscard]] std::string run(std::optional<std::uint64_t> maxFrames, const Over& over);

    // The following functions must be called through the CallQueue, which calls them between two
    // pictures. All throw std::runtime_error.
    /// Returns the last picture as the display got it; with `ofScreen`, as the screen shows it.
    [[nodiscard]] ScreenPicture snapshot(bool ofScreen) const;
    /// Requests one still, in any mode of the trigger.
    void askForStill();
    /// Deletes the learned filters.
    void resetLearning();
    /// These three functions call those of Rig.
    [[nodiscard]] std::function<std::shared_ptr<Recorder>()>
    makeRecording(const std::filesystem::path& folder) const {
        return rig_.makeRecording(folder);
    }
    void startRecording(std::shared_ptr<Recorder> recorder);
    [[nodiscard]] std::function<Recorded()> stopRecording() { return rig_.stopRecording(); }

private:
    /// A copy of a still that the pipeline uses.
    struct UsedStill {
        std::vector<std::uint8_t> pixels;
        ImageView view;
        Timestamp time;
        std::optional<Pose> pose;
    };
    void beginRecording(const Config& config);
    /// Starts the recording that beginRecording() requested, if its folder has been created by now.
    void takeFirstRecording();
    void checkRecording();
    [[nodiscard]] std::string showFrames(Mailbox<CapturedFrame>& mailbox, CaptureThread& capture,
                                         std::optional<std::uint64_t> maxFrames);
    void apply(const Tunables& wanted);
    /// Applies pending changes and calls, then processes and shows the frame. Without a frame,
    /// shows the fault, if there is one.
    void showNext(std::optional<CapturedFrame>& captured);
    /// Returns the deadline of a picture [ms]; 0: there is no deadline.
    [[nodiscard]] double deadlineMs() const;
    /// Returns whether objects can be shown. Opens GL if they need it; reports a failure.
    bool canShowObjects();
    void placeObjects();
    /// Creates drawing_ with the open GL context, or without GL. All settings and the stills in use
    /// are applied to it.
    void makeDrawing();
    /// Creates drawing_ in a new GL context after the GPU lost all objects. Throws Failure if that
    /// fails.
    void makeDrawingAnew(std::string why);
    [[nodiscard]] std::optional<std::string> gpuFault();
    [[nodiscard]] std::string bannerText();
    [[nodiscard]] Rendering rendering() const;
    void keepUsedStill(const CapturedStill& still);
    /// Keeps the copy of the pipeline's second still. Must be called after Pipeline::setStill().
    void keepSecondStill();
    [[nodiscard]] bool mayDraw();
    /// Processes and shows a frame. If it throws because the GPU is lost, `captured` can be
    /// processed again.
    void process(CapturedFrame& captured);
    void takeStill(CapturedStill still);
    void useStill();
    void fireIfNeeded(Timestamp frame, const FrameStats& stats);
    void setUpQuality(SuperResMode best);
    void setQuality(const QualityLevel& level);
    /// Applies the governor's choice for the next frame.
    void govern();
    void showFault();
    void finishDisplay();
    /// Makes small copies of the last picture and the last still, if a report will be written.
    void leavePictures();
    [[nodiscard]] FileDisplayPolicy displayPolicy();
    void setLearning(bool wanted);
    void takeFilters();
    void endLearning();
    void tell(Timestamp time);
    void tellLearning();
    void tellFaultyPasses();
    void show(Timestamp time, bool unchanged);

    Stats& stats_;
    Heartbeat* heart_ = nullptr;  ///< the GL thread's heartbeat; null: no pictures are made now
    Mailbox<Tunables>& changes_;
    CallQueue<Session>& calls_;
    StopTokens stop_;
    Config config_;  ///< the configuration, with the changes since the start
    Rig rig_;
    std::future<std::shared_ptr<Recorder>> firstRecording_;  ///< valid while its folder is created
    PoseFinder poses_;
    GlDevice device_ = GlDevice::Preferred;
    OpenedGl gl_;
    std::unique_ptr<Display> display_;
    Size output_;
    GpuFailures failures_;
    std::unique_ptr<FilterLearning> learning_;  ///< null: filters are not learned
    std::shared_ptr<const FilterBank>
        filters_;                       ///< learned filters; null: the shipped ones are used
    std::optional<Quality> quality_;    ///< quality of the pipeline; not set: as configured
    std::unique_ptr<Drawing> drawing_;  ///< uses learning_, so it is declared after it
    StillPolicy policy_;
    std::optional<CapturedStill> newestStill_;  ///< a still that the pipeline has not got yet
    // Copies of stills, for a loss of the GPU and for the report; set if steps run on GLES or a
    // report is written. They are the newest still in use, the pipeline's second still, and the
    // previous one, whose memory is reused.
    std::optional<UsedStill> usedStill_, secondStill_, formerStill_;
    TriggerReports triggerReports_;
    std::vector<QualityLevel> levels_;  ///< empty: the quality is as configured
    std::optional<Governor> governor_;
    Governor::Choice choice_{};          ///< the choice that the pipeline uses now
    std::vector<StageTime> stages_;      ///< times of the last picture's stages
    std::optional<Timestamp> previous_;  ///< time of the frame of the pipeline's statistics
    std::optional<Timestamp> stillTime_;
    TagMap tags_;
    std::string sensors_;  ///< names the sensors for which filters are learned
    std::uint64_t pictures_ = 0;
    ValidationCounts validated_{};
    RunDescription description_;
};

}  // namespace mfar
