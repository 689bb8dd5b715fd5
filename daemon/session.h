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

struct StopTokens {
    /// After a stop request, no more frames are fetched. Frames that are being processed are still
    /// shown and written.
    std::stop_token input;
    /// After a stop request, no thread waits any longer for a slow reader of the display's pipe.
    std::stop_token cancel;
};

/// One run, from the devices to the display. The picture thread creates, runs and destroys it.
class Session {
public:
    /// Opens devices, GL and display. All references must outlive this object. Throws Failure.
    Session(const Config& config, Stats& stats, Mailbox<Tunables>& changes,
            CallQueue<Session>& calls, StopTokens stop);
    ~Session();

    [[nodiscard]] const RunDescription& description() const { return description_; }
    [[nodiscard]] std::string startLine() const;

    using Over = std::function<void(const std::string& reason, const std::exception_ptr& error)>;
    /// Processes frames until the source ends, a stop is requested or `maxFrames` frames are shown.
    /// Waits until their pictures are written, then calls `over` with the reason of the end. If the
    /// run fails, calls `over` with the error. The work that remains after that call may hang:
    /// ending the learning and closing the devices. Returns the reason of the end. Throws Failure.
    [[nodiscard]] std::string run(std::optional<std::uint64_t> maxFrames, const Over& over);

    // Other threads must not call the following functions directly, but through the CallQueue. The
    // picture thread executes queued calls between two pictures. Each of these functions may throw
    // std::runtime_error.

    /// Returns the last picture as it was given to the display. If `ofScreen` is true, returns it
    /// as the screen shows it.
    [[nodiscard]] ScreenPicture snapshot(bool ofScreen) const;
    void askForStill();
    void resetLearning();
    [[nodiscard]] std::function<std::shared_ptr<Recorder>()>
    makeRecording(const std::filesystem::path& folder) const {
        return rig_.makeRecording(folder);
    }
    void startRecording(std::shared_ptr<Recorder> recorder);
    [[nodiscard]] std::function<Recorded()> stopRecording() { return rig_.stopRecording(); }

private:
    struct UsedStill {
        std::vector<std::uint8_t> pixels;
        ImageView view;
        Timestamp time;
        std::optional<Pose> pose;
    };
    void beginRecording(const Config& config);
    /// If the folder of the recording that beginRecording() requested has been created, starts that
    /// recording.
    void takeFirstRecording();
    void checkRecording();
    [[nodiscard]] std::string showFrames(Mailbox<CapturedFrame>& mailbox, CaptureThread& capture,
                                         std::optional<std::uint64_t> maxFrames);
    void apply(const Tunables& wanted);
    /// Applies pending changes and calls. Then processes and shows the frame. If there is no frame
    /// but a device has a fault, shows that fault.
    void showNext(std::optional<CapturedFrame>& captured);
    [[nodiscard]] double deadlineMs() const;
    /// Returns true if virtual objects can be shown. If they need GL and it is not open, tries to
    /// open it. If that fails, reports the failure and returns false.
    bool canShowObjects();
    void placeObjects();
    /// Creates drawing_, with the open GL context or without GL. Gives it all settings and the
    /// stills in use.
    void makeDrawing();
    /// After a loss of the GPU, creates drawing_ in a new GL context, or for the CPU if the GPU was
    /// lost too often. `why` is the reason of the loss. Throws Failure or std::runtime_error if
    /// that fails, too.
    void makeDrawingAnew(std::string why);
    [[nodiscard]] std::optional<std::string> gpuFault();
    [[nodiscard]] std::string bannerText();
    [[nodiscard]] Rendering rendering() const;
    void keepUsedStill(const CapturedStill& still);
    void keepSecondStill();
    [[nodiscard]] bool mayDraw();
    /// Processes and shows a frame. If this throws because the GPU is lost, the same frame can be
    /// processed again.
    void process(CapturedFrame& captured);
    void takeStill(CapturedStill still);
    void useStill();
    [[nodiscard]] bool mayDemandStill() const;
    void fireIfNeeded(Timestamp frame, const FrameStats& stats);
    void setUpQuality(SuperResMode best);
    void setQuality(const QualityLevel& level);
    void govern();
    void showFault();
    void finishDisplay();
    void leavePictures();
    [[nodiscard]] FileDisplayPolicy displayPolicy();
    void setLearning(bool wanted);
    void takeFilters();
    void endLearning();
    void tell(Timestamp time, const FrameStats& frame);
    void tellTracing(Timestamp time, const FrameStats& frame);
    void tellLearning();
    void tellFaultyPasses();
    void show(Timestamp time, bool unchanged);

    Stats& stats_;
    Heartbeat* heart_ = nullptr;  ///< the picture thread's heartbeat; null: no pictures are made
    Mailbox<Tunables>& changes_;
    /// A change is applied anew if the GPU was lost meanwhile.
    std::optional<Tunables> change_;
    CallQueue<Session>& calls_;
    StopTokens stop_;
    Config config_;
    Rig rig_;
    /// The first recording, which beginRecording() requests. Valid until the recording has started
    /// or its folder could not be created.
    std::future<std::shared_ptr<Recorder>> firstRecording_;
    PoseFinder poses_;
    GlDevice device_ = GlDevice::Preferred;
    OpenedGl gl_;
    std::unique_ptr<Display> display_;
    Size output_;
    GpuFailures failures_;
    std::unique_ptr<FilterLearning> learning_;
    /// The learned filters in use; null: the shipped filters are used.
    std::shared_ptr<const FilterBank> filters_;
    std::optional<Quality> quality_;
    std::unique_ptr<Drawing> drawing_;  ///< declared after learning_, which it uses
    StillPolicy policy_;
    std::optional<CapturedStill> newestStill_;
    // Copies of three stills. usedStill_ is in use, secondStill_ is the pipeline's second still,
    // and formerStill_ was in use before usedStill_. The copies are needed for the report, and to
    // go on after a loss of the GPU. They are not set if there is no GL context and no report is
    // written. formerStill_ may become the second still. Otherwise, its memory is reused for the
    // next still.
    std::optional<UsedStill> usedStill_, secondStill_, formerStill_;
    TriggerReports triggerReports_;
    std::vector<QualityLevel> levels_;
    std::optional<Governor> governor_;
    Governor::Choice choice_{};
    std::vector<StageTime> stages_;
    /// Time of the last processed frame. With the GLES engine, FrameStats::explained of the next
    /// frame belongs to this frame.
    std::optional<Timestamp> previous_;
    std::optional<Timestamp> stillTime_;
    std::optional<Timestamp> shownAt_;  ///< time at which the display got its last picture
    TagMap tags_;
    std::string sensors_;
    std::uint64_t pictures_ = 0;
    ValidationCounts validated_{};
    RunDescription description_;
};

}  // namespace mfar
