#include "daemon/rig.h"

#include "daemon/budgets.h"
#include "daemon/rig_cameras.h"
#include "daemon/rig_inputs.h"
#include "daemon/rig_source.h"
#include "daemon/rig_words.h"
#include "hal/device/display_auto.h"
#include "hal/virtual/display_files.h"
#include "hal/virtual/recorder.h"
#include "hal/virtual/recording_player.h"
#include "hal/virtual/synthetic_board.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace mfar {
namespace {

Pace playerPace(SourcePace wanted, SourcePace automatic) {
    const SourcePace pace = wanted == SourcePace::Auto ? automatic : wanted;
    return pace == SourcePace::Realtime ? Pace::Realtime : Pace::Consumer;
}

HandOver handOverAt(Pace pace) {
    return pace == Pace::Realtime ? HandOver::NewestWins : HandOver::Lossless;
}

struct SyntheticSource final : RigSource {
    explicit SyntheticSource(const Config& config) : source(config.source), board(options(config)) {
        handOver = handOverAt(options(config).pace);
        std::vector<MappedTag> known;
        for (const synthetic::Tag& tag : board.world().tags)
            // A moving tag is not in the tag map, because it has no fixed pose in the world.
            if (!tag.moves)
                known.push_back({{TagFamily::Tag36h11, tag.id}, tag.size, tag.T_world_tag});
        tags = TagMap(known);
    }
    static SyntheticOptions options(const Config& config) {
        SyntheticOptions options;
        const SourceWords words = sourceWords(config.source);
        if (words.scene) options.scene = synthetic::sceneNamed(*words.scene).value();
        if (words.path) options.path = synthetic::pathNamed(*words.path);
        options.seed = config.seed;
        options.pace = playerPace(config.pace, SourcePace::Realtime);
        return options;
    }
    [[nodiscard]] const StereoRig& geometry() const override { return board.rig(); }
    [[nodiscard]] Camera& video() override { return board.video(); }
    [[nodiscard]] Camera& still() override { return board.stills(); }
    [[nodiscard]] Trigger* trigger() override { return &board.trigger(); }
    [[nodiscard]] std::string name() const override { return source; }

    std::string source;
    SyntheticBoard board;
};

struct PlayedSource final : RigSource {
    explicit PlayedSource(const Config& config)
        : player(recordingOf(config),
                 {.pace = playerPace(config.pace, SourcePace::Consumer), .asksVideoFirst = true}) {
        handOver = handOverAt(playerPace(config.pace, SourcePace::Consumer));
        failure = ExitCode::BadData;
        videoFrames = player.recording().video.size();
        recordedTimeOffset =
            std::chrono::nanoseconds(std::llround(player.recording().stillTimeOffset * 1e9));
        if (const auto file = player.recording().root / "tags.toml"; std::filesystem::exists(file))
            tags = readTagMap(file);
        if (!player.recording().poses.empty())
            recordedPoses = [this](Timestamp t) { return player.recording().poseAt(t); };
    }
    [[nodiscard]] const StereoRig& geometry() const override { return player.recording().rig; }
    [[nodiscard]] Camera& video() override { return player.video(); }
    [[nodiscard]] Camera& still() override { return player.stills(); }
    [[nodiscard]] Trigger* trigger() override { return nullptr; }
    [[nodiscard]] std::string name() const override {
        return "recording " + player.recording().root.string();
    }

    RecordingPlayer player;
};

void finish(Recorder& recorder) {
    orFail(ExitCode::OutputFailed, [&] { recorder.finish(); });
}

std::uint64_t lostBy(const Recorder& recorder) {
    return recorder.videoCounts().dropped + recorder.stillCounts().dropped;
}

std::unique_ptr<RigSource> openSource(const Config& config, Heartbeats& hearts) {
    if (!config.recording.empty()) return std::make_unique<PlayedSource>(config);
    if (const std::optional<std::string> fault = sourceFault(config.source))
        throw Failure(ExitCode::BadConfig, *fault);
    requireSourceMemory(config);
    if (config.source == kCameras) return std::make_unique<CamerasSource>(config.cameras, hearts);
    try {
        return std::make_unique<SyntheticSource>(config);
    } catch (const std::runtime_error& error) {
        throw Failure(ExitCode::Unavailable, config.source + ": " + error.what());
    }
}

}  // namespace

Rig::Rig(const Config& config, Heartbeats& hearts)
    : source_(openSource(config, hearts)), requiresNext_(!config.recordTo.empty()) {
    const auto bytes = [](double mb) { return static_cast<std::uint64_t>(mb * (1 << 20)); };
    recording_.leastFreeBytes = bytes(config.record.leastFreeMb);
    recording_.mostBytes = bytes(config.record.mostMb);
    recording_.writer = {&hearts, "recorder", budget::kWriter, ThreadRole::Helper};
    // A source that waits for mfard can also wait for a slow disk, so that no picture is lost.
    if (handOver() == HandOver::Lossless) recording_.patience = budget::kWriter;
}

Rig::Rig(std::unique_ptr<RigSource> source) : source_(std::move(source)) {}

Rig::~Rig() = default;

const StereoRig& Rig::geometry() const {
    return source_->geometry();
}

Camera& Rig::video() {
    return source_->video();
}

Camera& Rig::still() {
    return source_->still();
}

Trigger* Rig::trigger() {
    return source_->trigger();
}

HandOver Rig::handOver() const {
    return source_->handOver;
}

CameraKind Rig::cameraKind() const {
    if (source_->handOver == HandOver::Lossless) return CameraKind::Stored;
    return source_->hasSensors ? CameraKind::Sensor : CameraKind::Live;
}

std::chrono::nanoseconds Rig::stillTimeOffset() const {
    return source_->stillTimeOffset;
}

std::optional<std::uint64_t> Rig::videoFrames() const {
    return source_->videoFrames;
}

PoseInputs Rig::poseInputs() const {
    return {source_->name(), geometry(), source_->video().info().rateHz, source_->tags,
            source_->recordedPoses};
}

std::string Rig::description() const {
    const CameraInfo video = source_->video().info();
    const CameraInfo still = source_->still().info();
    return fmt::format("{}: video {}x{} at {:g} Hz, still {}x{}", source_->name(), video.size.width,
                       video.size.height, video.rateHz, still.size.width, still.size.height);
}

std::optional<StillCounters> Rig::matching() const {
    if (!source_->matching) return std::nullopt;
    return source_->matching();
}

std::optional<std::string> Rig::fault() const {
    return source_->fault ? source_->fault() : std::nullopt;
}

ExitCode Rig::inputFailure() const {
    return source_->failure;
}

std::shared_ptr<Recorder> Rig::recorder() const {
    const std::lock_guard lock(mutex_);
    return recorder_;
}

// The caller must have locked mutex_.
void Rig::requireNoRecorder() const {
    if (recorder_) throw Failure(ExitCode::OutputFailed, "a recording is already running");
}

std::function<std::shared_ptr<Recorder>()>
Rig::makeRecording(const std::filesystem::path& folder) const {
    const std::lock_guard lock(mutex_);
    requireNoRecorder();
    RecorderOptions options = recording_;
    const std::chrono::duration<double> added = stillTimeOffset() + source_->recordedTimeOffset;
    options.stillTimeOffset = added.count();
    return [folder, rig = geometry(), rateHz = source_->video().info().rateHz, options] {
        return orFail(ExitCode::OutputFailed,
                      [&] { return std::make_shared<Recorder>(folder, rig, rateHz, options); });
    };
}

void Rig::startRecording(std::shared_ptr<Recorder> recorder) {
    const std::lock_guard lock(mutex_);
    requireNoRecorder();
    recorder_ = std::move(recorder);
    isRequired_ = std::exchange(requiresNext_, false);
    broke_.reset();
}

std::function<Recorded()> Rig::stopRecording() {
    const std::lock_guard lock(mutex_);
    if (!recorder_)
        throw Failure(ExitCode::OutputFailed,
                      broke_ ? "the recording has ended: " + *broke_ : "nothing is being recorded");
    lostBefore_ += lostBy(*recorder_);
    isRequired_ = false;
    return [recorder = std::exchange(recorder_, nullptr)]() -> Recorded {
        finish(*recorder);
        return {recorder->folder(), recorder->videoCounts().written,
                recorder->stillCounts().written, lostBy(*recorder)};
    };
}

void Rig::recordVideo(const Frame& frame) {
    if (const auto to = recorder()) to->video(frame.view(), frame.time());
}

void Rig::recordStill(const Frame& frame) {
    if (const auto to = recorder()) to->still(frame.view(), frame.time());
}

void Rig::recordPose(const Pose& pose) {
    if (const auto to = recorder()) to->pose(pose);
}

void Rig::recordTags(const TagMap& tags) {
    const auto to = recorder();
    if (to && !tags.empty()) to->addFile("tags.toml", tomlOf(tags));
}

std::uint64_t Rig::notRecorded() const {
    const std::lock_guard lock(mutex_);
    return lostBefore_ + (recorder_ ? lostBy(*recorder_) : 0);
}

std::filesystem::path Rig::recordingFolder() const {
    const auto to = recorder();
    return to ? to->folder() : std::filesystem::path();
}

std::optional<std::string> Rig::endBrokenRecording() {
    const std::lock_guard lock(mutex_);
    if (!recorder_) return std::nullopt;
    std::optional<std::string> error = recorder_->error();
    if (!error) return std::nullopt;
    lostBefore_ += lostBy(*recorder_);
    broke_ = error;
    if (std::exchange(isRequired_, false)) requiredBroke_ = error;
    // Destroying the recorder may wait for a disk that hangs. So another thread destroys it, after
    // all threads that copy a frame into it have released it.
    ending_.emplace_back([recorder = std::exchange(recorder_, nullptr)]() mutable {
        while (recorder.use_count() > 1)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        recorder.reset();
    });
    return error;
}

std::optional<std::string> Rig::requiredFault() const {
    const std::lock_guard lock(mutex_);
    return requiredBroke_;
}

void Rig::finishRecording() {
    if (const auto to = recorder()) {
        try {
            finish(*to);
        } catch (const Failure& failure) {
            const std::lock_guard lock(mutex_);
            if (isRequired_ && recorder_ == to) throw RecordingLost(failure.what());
            // endBrokenRecording() reports the error of any other recording.
        }
    }
    const std::lock_guard lock(mutex_);
    if (requiredBroke_) throw RecordingLost(*requiredBroke_);
}

std::filesystem::path newRecordingIn(const std::filesystem::path& directory) {
    const auto seconds = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    const std::string name = fmt::format("{:%Y%m%d-%H%M%S}", fmt::gmtime(seconds));
    // The folder may exist already: without a battery-backed clock, the time is the same after
    // every boot.
    std::filesystem::path folder = directory / name;
    std::error_code ignored;
    for (int i = 2; std::filesystem::exists(folder, ignored); ++i)
        folder = directory / fmt::format("{}-{}", name, i);
    return folder;
}

std::unique_ptr<Display> openDisplay(const Config& config, double rateHz, std::stop_token cancel,
                                     const FileDisplayPolicy& policy) {
    return orFail(ExitCode::OutputFailed, [&]() -> std::unique_ptr<Display> {
        // Opening a display may replace a file. If --record names a folder that is not empty, mfard
        // must fail before that.
        if (!config.recordTo.empty()) requireNoRecording(config.recordTo);
        if (isScreen(config.display)) return openScreen(config.display);
        return openFileDisplay(config.display, rateHz, std::move(cancel), policy);
    });
}

ScreenPicture copyOf(const Picture& picture) {
    const Size size = picture.size();
    ScreenPicture copy{size, PixelFormat::Rgba8, {}};
    const std::size_t stride = std::size_t{4} * size.width;
    copy.pixels.resize(stride * size.height);
    copyPicture(picture, copy.pixels.data(), stride);
    return copy;
}

}  // namespace mfar
