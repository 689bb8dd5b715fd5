#include "tests/measure/eval/flow_samples.h"

#include "hal/virtual/image_files.h"
#include "tests/measure/eval/flow_truth.h"
#include "tests/measure/eval/picture.h"
#include "tests/measure/eval/report.h"
#include "tests/measure/eval/still_choice.h"

#include <fmt/format.h>

#include <system_error>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

namespace mfar::eval {
namespace {

namespace fs = std::filesystem;

std::optional<std::int64_t> parseDigits(const std::string& text) {
    std::int64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end || value < 0) return std::nullopt;
    return value;
}

std::map<std::int64_t, fs::path> numbered(const fs::path& folder, std::string_view prefix,
                                          std::string_view suffix) {
    std::map<std::int64_t, fs::path> out;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name.size() <= prefix.size() + suffix.size() || !name.starts_with(prefix) ||
            !name.ends_with(suffix))
            continue;
        const auto number =
            parseDigits(name.substr(prefix.size(), name.size() - prefix.size() - suffix.size()));
        if (number) out[*number] = entry.path();
    }
    return out;
}

StereoRig pairRig(const fs::path& picture) {
    const Size size = loadImage(picture).size;
    StereoRig rig;
    const double width = size.width, height = size.height;
    rig.video = {size, width, width, (width - 1) / 2, (height - 1) / 2, {}};
    rig.still = rig.video;
    return rig;
}

FlowSet pairsOf(const fs::path& folder) {
    const auto frames = numbered(folder, "frame", ".png");
    FlowSet out;
    for (const auto& [number, truth] : numbered(folder, "flow", ".flo")) {
        const auto a = frames.find(number), b = frames.upper_bound(number);
        if (a == frames.end() || b == frames.end())
            throw EvalError(fmt::format("{}: frame{}.png or the frame with the next higher number "
                                        "is missing in this folder",
                                        truth.string(), number));
        out.samples.push_back(
            {std::to_string(number), a->second, b->second, truth, {number}, {b->first}});
    }
    if (out.samples.empty())
        throw EvalError(
            fmt::format("{}: neither a recording (no folder cam0) nor a pair (no flowNN.flo)",
                        folder.string()));
    out.rig = pairRig(out.samples.front().video);
    return out;
}

const RecordedImage* pictureAt(const std::vector<RecordedImage>& images, std::int64_t ns) {
    const auto found = std::find_if(images.begin(), images.end(),
                                    [&](const RecordedImage& i) { return i.time.ns == ns; });
    return found == images.end() ? nullptr : &*found;
}

FlowSample sampleOf(const Recording& recording, const RecordedImage& video,
                    const RecordedImage& still, const fs::path& truth) {
    return {fmt::format("{}_{}", video.time.ns, still.time.ns),
            video.file,
            still.file,
            truth,
            video.time,
            still.time,
            posesOf(recording, video.time, still.time)};
}

struct RecordedFlows {
    std::vector<FlowSample> toStill, toVideo;

    void add(const Recording& recording, const fs::path& truth) {
        const std::string stem = truth.stem().string();
        const std::size_t bar = std::min(stem.find('_'), stem.size());
        const auto from = parseDigits(stem.substr(0, bar));
        const auto to = parseDigits(stem.substr(std::min(bar + 1, stem.size())));
        if (!from || !to)
            throw EvalError(
                fmt::format("{}: the file's name is not <ns>_<ns>.flo (times of two pictures)",
                            truth.string()));
        const RecordedImage* frame = pictureAt(recording.video, *from);
        const RecordedImage* still = pictureAt(recording.stills, *to);
        const RecordedImage* video = pictureAt(recording.video, *to);
        if (!frame || (!still && !video))
            throw EvalError(
                fmt::format("{}: the recording has no pictures at the two times in this file name",
                            truth.string()));
        if (!still)
            toVideo.push_back(sampleOf(recording, *frame, *video, truth));
        else if (!showsOwnView(recording, still->time, frame->time))
            toStill.push_back(sampleOf(recording, *frame, *still, truth));
    }
};

RecordedFlows recordedFlows(const Recording& recording) {
    RecordedFlows out;
    const fs::path folder = recording.root / "truth" / "flow";
    if (!fs::is_directory(folder)) return out;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".flo") out.add(recording, entry.path());
    return out;
}

std::vector<FlowSample> samplesByDepth(const Recording& recording) {
    std::vector<FlowSample> out;
    for (const RecordedImage& video : recording.video) {
        const auto truth = recording.truthInverseDepth(video.time);
        const auto still = truth ? referenceStill(recording, video.time) : std::nullopt;
        if (!still) continue;
        FlowSample sample = sampleOf(recording, video, recording.stills[*still], *truth);
        if (sample.poses.frame && sample.poses.still) out.push_back(std::move(sample));
    }
    return out;
}

FlowSet samplesOfRecording(const fs::path& folder) {
    const Recording recording = loadRecording(folder);
    RecordedFlows flows = recordedFlows(recording);
    FlowSet out{recording.rig, std::move(flows.toStill)};
    if (out.samples.empty()) out.samples = samplesByDepth(recording);
    if (out.samples.empty()) {
        out.samples = std::move(flows.toVideo);
        out.rig = {recording.rig.video, recording.rig.video, {}};
    }
    if (out.samples.empty())
        throw EvalError(fmt::format(
            "{}: no truth: neither truth/flow nor truth/inverse_depth gives the flow of a frame; "
            "mfar-sim makes recordings with truth",
            folder.string()));
    std::sort(out.samples.begin(), out.samples.end(), [](const FlowSample& x, const FlowSample& y) {
        return std::pair(x.videoTime, x.stillTime) < std::pair(y.videoTime, y.stillTime);
    });
    return out;
}

void requireFolder(const fs::path& folder) {
    if (!fs::is_directory(folder))
        throw EvalError(fmt::format("{}: no such folder", folder.string()));
}

void requireSize(const fs::path& file, Size got, Size wanted) {
    if (got != wanted)
        throw EvalError(fmt::format("{}: has {}x{} pixels; expected {}x{}", file.string(),
                                    got.width, got.height, wanted.width, wanted.height));
}

Shot shotOf(const fs::path& file, Timestamp time, const std::optional<Pose>& pose, Size wanted) {
    Shot out{loadPicture(file), time, pose};
    requireSize(file, {out.picture.cols, out.picture.rows}, wanted);
    return out;
}

}  // namespace

FlowSet flowSamplesOf(const fs::path& folder) {
    requireFolder(folder);
    return fs::exists(folder / "cam0") ? samplesOfRecording(folder) : pairsOf(folder);
}

FlowSet depthSamplesOf(const fs::path& folder) {
    requireFolder(folder);
    const Recording recording = loadRecording(folder);
    FlowSet out{recording.rig, samplesByDepth(recording)};
    if (out.samples.empty())
        throw EvalError(fmt::format("{}: no truth: no frame has both truth/inverse_depth and a "
                                    "still with a known pose; mfar-sim makes recordings with truth",
                                    folder.string()));
    return out;
}

cv::Mat loadTruth(const FlowSet& set, const FlowSample& sample) {
    const Size size = set.rig.video.size;
    if (sample.truth.extension() == ".pfm") {
        const FloatImage truth = loadPfm(sample.truth);
        requireSize(sample.truth, truth.size, size);
        return flowOfInverseDepth(
            truth, set.rig, stillFromFrame(set.rig, *sample.poses.frame, *sample.poses.still));
    }
    FlowImage truth = loadFlo(sample.truth);
    requireSize(sample.truth, truth.size, size);
    return cv::Mat(size.height, size.width, CV_32FC2, truth.vectors.data()).clone();
}

Shot loadFrame(const FlowSet& set, const FlowSample& sample) {
    return shotOf(sample.video, sample.videoTime, sample.given.value_or(sample.poses).frame,
                  set.rig.video.size);
}

Shot loadStill(const FlowSet& set, const FlowSample& sample) {
    return shotOf(sample.still, sample.stillTime, sample.given.value_or(sample.poses).still,
                  set.rig.still.size);
}

}  // namespace mfar::eval
