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

/// The settings that can be changed while running.
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

/// Two ways to end a session from outside.
struct StopTokens {
    std::stop_token input;   ///< no more frames; what has been processed is still shown and written
    std::stop_token cancel;  ///< also stop waiting for a slow display
};

/// One run from devices to display: everything that lives on the GL thread. Created, run and
/// destroyed by that thread.
class Session {
public:
    /// Opens devices, GL and display. All references must outlive this. Throws Failure.
    Session(const Config& config, Stats& stats, Mailbox<Tunables>& changes,
            CallQueue<Session>& calls, StopTokens stop);
    ~Session();

    [[nodiscard]] const RunDescription& description() const { return description_; }
    /// The line logged at the start: renderer, sensors, display, output size.
    [[nodiscard]] std::string startLine() const;

    /// Receives the reason why the pictures ended, or the error.
    using Over = std::function<void(const std::string& reason, const std::exception_ptr& error)>;
    /// Processes frames until the source ends, a stop is requested or `maxFrames` are shown, and
    /// waits until they are written. Then calls `over`: all that is left is closing the devices,
    /// which may hang. Returns the reason of the end. Throws Failure.
    [[nodiscard]] std::string run(std::optional<std::uint64_t> maxFrames, const Over& over);

    // To be called through the CallQueue, between two pictures. All throw std::runtime_error.
    /// The last picture: as it went to the display, or as the display's screen shows it.
    [[nodiscard]] ScreenPicture snapshot(bool ofScreen) const;
    /// Requests one still, whatever the trigger configuration is.
    void askForStill();
    /// Deletes the learned filters.
    void resetLearning();
    /// See Rig.
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
    /// Starts the recording requested by beginRecording(), once its folder has been created.
    void takeFirstRecording();
    void checkRecording();
    [[nodiscard]] std::string showFrames(Mailbox<CapturedFrame>& mailbox, CaptureThread& capture,
                                         std::optional<std::uint64_t> maxFrames);
    void apply(const Tunables& wanted);
    /// Applies pending changes and calls, then shows the frame; without a frame, shows a fault.
    void showNext(std::optional<CapturedFrame>& captured);
    /// Deadline of a picture [ms]; 0: no deadline.
    [[nodiscard]] double deadlineMs() const;
    /// Opens GL for the objects if it is not open yet; reports a failure.
    bool canShowObjects();
    void placeObjects();
    /// Creates drawing_ on the open context, or without one, with all settings and the stills in
    /// use.
    void makeDrawing();
    /// Creates drawing_ on a new context after the GPU has lost everything. Throws Failure when
    /// that fails.
    void makeDrawingAnew(std::string why);
    [[nodiscard]] std::optional<std::string> gpuFault();
    [[nodiscard]] std::string bannerText();
    [[nodiscard]] Rendering rendering() const;
    void keepUsedStill(const CapturedStill& still);
    /// To be called after the pipeline has taken the still.
    void keepSecondStill();
    [[nodiscard]] bool mayDraw();
    /// Keeps the parts of `captured` that are needed to process it again after a GPU loss.
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
    /// Small copies of the last picture and still, if there will be a report.
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
    Heartbeat* heart_ = nullptr;  ///< the GL thread's, while pictures are made
    Mailbox<Tunables>& changes_;
    CallQueue<Session>& calls_;
    StopTokens stop_;
    Config config_;  ///< with the changes so far
    Rig rig_;
    std::future<std::shared_ptr<Recorder>> firstRecording_;  ///< valid: its folder is being created
    PoseFinder poses_;
    GlDevice device_ = GlDevice::Preferred;
    OpenedGl gl_;
    std::unique_ptr<Display> display_;
    Size output_;
    GpuFailures failures_;
    std::unique_ptr<FilterLearning> learning_;   ///< null: no learning
    std::shared_ptr<const FilterBank> filters_;  ///< learned; null: none yet, or the shipped ones
    std::optional<Quality> quality_;    ///< current, in the pipeline; nothing: as configured
    std::unique_ptr<Drawing> drawing_;  ///< reports to learning_, so it is destroyed first
    StillPolicy policy_;
    std::optional<CapturedStill> newestStill_;  ///< not used yet
    // Set where steps run on GLES or a report is written: the newest still in use, the one that the
    // pipeline keeps next to it, and the previous one, whose memory is reused.
    std::optional<UsedStill> usedStill_, secondStill_, formerStill_;
    TriggerReports triggerReports_;
    std::vector<QualityLevel> levels_;  ///< empty: the quality is as configured
    std::optional<Governor> governor_;
    Governor::Choice choice_{};          ///< current, in the pipeline
    std::vector<StageTime> stages_;      ///< of the last picture
    std::optional<Timestamp> previous_;  ///< the frame that the pipeline's statistics are about
    std::optional<Timestamp> stillTime_;
    TagMap tags_;
    std::string sensors_;  ///< the sensors that filters are learned for
    std::uint64_t pictures_ = 0;
    ValidationCounts validated_{};
    RunDescription description_;
};

}  // namespace mfar
