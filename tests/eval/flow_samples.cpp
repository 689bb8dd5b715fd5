#include "tests/eval/flow_samples.h"

#include "hal/virtual/image_files.h"
#include "hal/virtual/recording.h"
#include "tests/eval/picture.h"
#include "tests/eval/report.h"
#include "tests/eval/rig_resample.h"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

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

/// The whole text as a number, digits only; nothing when it is none or does not fit.
std::optional<std::int64_t> parseDigits(const std::string& text) {
    std::int64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end || value < 0) return std::nullopt;
    return value;
}

/// Files named prefix, number, suffix: by their number.
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

std::vector<FlowSample> pairsOf(const fs::path& folder) {
    const auto frames = numbered(folder, "frame", ".png");
    std::vector<FlowSample> out;
    for (const auto& [number, truth] : numbered(folder, "flow", ".flo")) {
        const auto a = frames.find(number), b = frames.upper_bound(number);
        if (a == frames.end() || b == frames.end())
            throw EvalError(fmt::format("{}: needs frame{}.png and a later frame beside it",
                                        truth.string(), number));
        out.push_back({std::to_string(number), a->second, b->second, truth});
    }
    if (out.empty())
        throw EvalError(fmt::format("{}: neither a recording (no cam0) nor a pair (no flowNN.flo)",
                                    folder.string()));
    return out;
}

std::optional<fs::path> pictureAt(const std::vector<RecordedImage>& images, std::int64_t ns) {
    const auto found = std::find_if(images.begin(), images.end(),
                                    [&](const RecordedImage& i) { return i.time.ns == ns; });
    return found == images.end() ? std::nullopt : std::optional(found->file);
}

FlowSample recordedSample(const Recording& recording, const fs::path& truth) {
    const std::string stem = truth.stem().string();
    const std::size_t bar = std::min(stem.find('_'), stem.size());
    const auto from = parseDigits(stem.substr(0, bar));
    const auto to = parseDigits(stem.substr(std::min(bar + 1, stem.size())));
    if (!from || !to) throw EvalError(fmt::format("{}: name is not <ns>_<ns>.flo", truth.string()));
    const auto a = pictureAt(recording.video, *from);
    const auto still = pictureAt(recording.stills, *to);
    const auto video = pictureAt(recording.video, *to);
    if (!a || (!still && !video))
        throw EvalError(fmt::format("{}: no picture was taken at these times", truth.string()));
    return {stem, *a, still ? *still : *video, truth,
            still ? std::optional(recording.rig) : std::nullopt};
}

std::vector<FlowSample> samplesOfRecording(const fs::path& folder) {
    const Recording recording = loadRecording(folder);
    std::vector<FlowSample> out;
    if (fs::is_directory(folder / "truth" / "flow"))
        for (const auto& entry : fs::directory_iterator(folder / "truth" / "flow"))
            if (entry.path().extension() == ".flo")
                out.push_back(recordedSample(recording, entry.path()));
    if (out.empty())
        throw EvalError(fmt::format("{}: no truth: truth/flow has no .flo file", folder.string()));
    std::sort(out.begin(), out.end(), [](const FlowSample& x, const FlowSample& y) {
        return x.truth.filename() < y.truth.filename();
    });
    return out;
}

cv::Mat grey(const cv::Mat& picture) {
    cv::Mat out;
    cv::cvtColor(picture, out, cv::COLOR_BGR2GRAY);
    return out;
}

void requireSameSize(const fs::path& file, const cv::Mat& got, const cv::Mat& wanted) {
    if (got.size() != wanted.size())
        throw EvalError(fmt::format("{}: has {}x{} pixels, its first frame {}x{}", file.string(),
                                    got.cols, got.rows, wanted.cols, wanted.rows));
}

}  // namespace

std::vector<FlowSample> flowSamplesOf(const fs::path& folder) {
    if (!fs::is_directory(folder))
        throw EvalError(fmt::format("{}: no such folder", folder.string()));
    return fs::exists(folder / "cam0") ? samplesOfRecording(folder) : pairsOf(folder);
}

FlowPictures loadFlowPictures(const FlowSample& sample) {
    FlowPictures out;
    out.a = grey(loadPicture(sample.a));
    const cv::Mat b = loadPicture(sample.b);
    out.b = grey(sample.rig ? resampleStill(b, *sample.rig) : b);
    requireSameSize(sample.b, out.b, out.a);
    FlowImage truth = loadFlo(sample.truth);
    out.truth =
        cv::Mat(truth.size.height, truth.size.width, CV_32FC2, truth.vectors.data()).clone();
    requireSameSize(sample.truth, out.truth, out.a);
    return out;
}

}  // namespace mfar::eval
