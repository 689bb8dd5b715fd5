#include "daemon/rig_inputs.h"

#include "daemon/rig_cameras.h"
#include "daemon/rig_words.h"
#include "hal/virtual/synthetic_scene.h"

#include <system_error>

#include <optional>
#include <string>

namespace mfar {
namespace {

class Faults {
public:
    explicit Faults(const Config& config) : config_(config) {}

    /// Calls `check`. If it throws a Failure, adds the fault of this key and returns false.
    template <class Check>
    bool add(const char* key, const Check& check) {
        try {
            check();
            return true;
        } catch (const Failure& failure) {
            all_ += all_.empty() ? "" : "\n";
            all_ += config_.placeOf(key) + failure.what();
            if (!code_) code_ = failure.code;
            return false;
        }
    }
    void require() const {
        if (code_) throw Failure(*code_, all_);
    }

private:
    const Config& config_;
    std::optional<ExitCode> code_;
    std::string all_;
};

void requireFolder(const std::filesystem::path& recording) {
    std::error_code ignored;
    if (!std::filesystem::is_directory(recording, ignored))
        throw Failure(ExitCode::NoInput, recording.string() + ": there is no such recording");
}

}  // namespace

void requireFiles(const Config& config, RecordingCheck check) {
    Faults faults(config);
    if (!config.recording.empty()) {
        faults.add("recording", [&] {
            requireFolder(config.recording);
            if (check == RecordingCheck::Lists) (void)recordingOf(config);
        });
    } else {
        if (config.source == kCameras)
            faults.add("cameras.calibration", [&] { (void)calibrationOf(config.cameras); });
        faults.add("limits.memory_mb", [&] { requireSourceMemory(config); });
    }
    faults.add("pose.tags", [&] { (void)configuredTags(config.pose); });
    if (faults.add("governor.table", [&] { (void)knownLevels(config.governor); }))
        faults.add("governor.pin", [&] { (void)governedLevels(config.governor); });
    faults.require();
}

void requireSourceMemory(const Config& config) {
    StereoRig rig = synthetic::boardRig();
    if (config.source == kCameras)
        rig = nominalRig(config.cameras.video.size, config.cameras.still.size);
    requireMemory(config.limits, rig.video.size, rig.still.size, config.source);
}

Recording recordingOf(const Config& config) {
    const std::filesystem::path& folder = config.recording;
    requireFolder(folder);
    Recording out = orFail<RecordingError>(
        ExitCode::BadData, [&] { return loadRecording(folder, config.limits.pictureBytes()); });
    requireMemory(config.limits, out.rig.video.size, out.rig.still.size, folder.string(),
                  memoryOf(out));
    return out;
}

}  // namespace mfar
