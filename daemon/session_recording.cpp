#include "daemon/budgets.h"
#include "daemon/exit_code.h"
#include "daemon/session.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace mfar {

// If the folder of --record cannot be created, mfard does not start. If a folder in the directory
// of [record] cannot be created, mfard runs without a recording. Another thread creates the folder
// in that directory. The picture thread waits for the other thread only with a lossless source, so
// that all pictures are recorded.
void Session::beginRecording(const Config& config) {
    if (!config.recordTo.empty()) return startRecording(makeRecording(config.recordTo)());
    if (config.record.directory.empty()) return;
    firstRecording_ = std::async(
        std::launch::async, [this, &hearts = stats_.heartbeats(), in = config.record.directory] {
            const Heartbeat heart(hearts, "recording opener", budget::kWriter, ThreadRole::Helper);
            return makeRecording(newRecordingIn(in))();
        });
    if (rig_.handOver() == HandOver::Lossless) firstRecording_.wait();
    takeFirstRecording();
}

void Session::takeFirstRecording() {
    constexpr std::chrono::seconds kNow{0};
    if (!firstRecording_.valid() || firstRecording_.wait_for(kNow) != std::future_status::ready)
        return;
    try {
        startRecording(firstRecording_.get());
    } catch (const Failure& failure) {
        stats_.warn(fmt::format("nothing is recorded: {}", failure.what()), {message::kRecording});
    }
}

void Session::checkRecording() {
    takeFirstRecording();
    if (const std::optional<std::string> why = rig_.endBrokenRecording())
        stats_.warn(fmt::format("the recording has ended: {}", *why), {message::kRecording});
    stats_.recording(rig_.recordingFolder(), rig_.requiredFault());
}

void Session::startRecording(std::shared_ptr<Recorder> recorder) {
    rig_.startRecording(std::move(recorder));
    rig_.recordTags(tags_);
}

}  // namespace mfar
