#include "daemon/exit_code.h"
#include "daemon/session.h"

#include <fmt/format.h>

#include <utility>

namespace mfar {

// Who names a folder on the command line is told at once; a service goes on without its recording.
void Session::beginRecording(const Config& config) {
    if (!config.recordTo.empty()) {
        startRecording(makeRecording(config.recordTo)());
    } else if (!config.record.directory.empty()) {
        try {
            startRecording(makeRecording(newRecordingIn(config.record.directory))());
        } catch (const Failure& failure) {
            stats_.warn(fmt::format("nothing is recorded: {}", failure.what()),
                        {message::kRecording});
        }
    }
}

void Session::checkRecording() {
    if (const std::optional<std::string> why = rig_.endBrokenRecording())
        stats_.warn(fmt::format("the recording has ended: {}", *why), {message::kRecording});
    stats_.recording(rig_.recordingFolder());
}

void Session::startRecording(std::shared_ptr<Recorder> recorder) {
    rig_.startRecording(std::move(recorder));
    rig_.recordTags(tags_);
}

}  // namespace mfar
