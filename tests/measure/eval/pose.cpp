#include "tests/measure/eval/pose.h"

#include "hal/virtual/image_files.h"
#include "hal/virtual/recording.h"
#include "tests/measure/eval/labels.h"
#include "tests/measure/eval/stopwatch.h"
#include "tests/measure/eval/tag_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <optional>

namespace mfar::eval {
namespace {

namespace fs = std::filesystem;

// Largest change of the rotation error between consecutive frames that noise can explain [degrees].
// A larger change counts as a flip between the two planar solutions of a pose.
constexpr double kFlipDeg = 3;

const std::vector<Column> kColumns{
    {"ms", 2},         {"rot_deg", 4},   {"trans_mm", 3}, {"trans_percent", 3},
    {"jitter_deg", 4}, {"jitter_mm", 3}, {"tags", 1},     {"flips", 0},
    {"corner_px", 3},  {"found", 2},     {"missed", 3},   {"false", 3}};
enum At {
    Ms,
    Rot,
    Trans,
    Percent,
    JitterRot,
    JitterTrans,
    Tags,
    Flips,
    Corner,
    Found,
    Missed,
    False
};

using Values = std::vector<std::optional<double>>;

Values none() {
    return Values(kColumns.size());
}

/// Motion from the true pose to the measured pose, in coordinates of the true camera.
RigidTransform errorOf(const Pose& measured, const Pose& truth) {
    return truth.T_world_video.inverse() * measured.T_world_video;
}

double degrees(const RigidTransform& motion) {
    return motion.rotation.angularDistance(Eigen::Quaterniond::Identity()) * 180 / std::numbers::pi;
}

double distanceTo(const std::vector<TagDetection>& seen, const TagMap& map, const Pose& truth) {
    double sum = 0;
    int count = 0;
    for (const TagDetection& tag : seen)
        if (const MappedTag* known = map.find(tag.tag)) {
            sum += (known->T_world_tag.translation - truth.T_world_video.translation).norm();
            ++count;
        }
    return count > 0 ? sum / count : 0;
}

class Series {
public:
    Series(Report& report, std::string recording, std::string method)
        : report_(report), recording_(std::move(recording)), method_(std::move(method)) {}

    void add(Timestamp time, double ms, const std::optional<Pose>& measured, const Pose& truth,
             double distance) {
        Values row = none();
        row[Ms] = ms;
        row[Missed] = measured ? 0 : 1;
        std::optional<RigidTransform> error;
        if (measured) {
            error = errorOf(*measured, truth);
            row[Rot] = degrees(*error);
            row[Trans] = 1000 * error->translation.norm();
            if (distance > 0) row[Percent] = 100 * error->translation.norm() / distance;
            row[Tags] = measured->tags;
        }
        if (error && before_) {
            const RigidTransform change = before_->inverse() * *error;
            row[JitterRot] = degrees(change);
            row[JitterTrans] = 1000 * change.translation.norm();
            flips_ += *row[JitterRot] > kFlipDeg ? 1 : 0;
        }
        before_ = error;
        rows_.push_back(row);
        report_.add(recording_, std::to_string(time.ns), method_, std::move(row));
    }

    /// Adds the row with the medians. Call it after Report::addMeans(), because otherwise the means
    /// would include this row.
    void addMedian() const {
        if (rows_.empty()) return;
        Values out = none();
        for (std::size_t c = 0; c < out.size(); ++c) {
            std::vector<double> known;
            for (const Values& row : rows_)
                if (row[c]) known.push_back(*row[c]);
            if (known.empty()) continue;
            const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
            std::nth_element(known.begin(), middle, known.end());
            out[c] = *middle;
        }
        out[Flips] = flips_;
        report_.add(recording_, "median", method_, std::move(out));
    }

private:
    Report& report_;
    std::string recording_, method_;
    std::optional<RigidTransform> before_;
    std::vector<Values> rows_;
    int flips_ = 0;
};

class RecordingRun {
public:
    RecordingRun(Report& report, const PoseRequest& request, const fs::path& folder,
                 const std::string& label)
        : request_(request), recording_(loadRecording(folder)),
          map_(loadTagMap(folder / "tags.toml")), tracker_(recording_.rig, trackerOptions()) {
        if (recording_.poses.empty())
            throw EvalError(
                fmt::format("{}: the recording has no poses to compare with", folder.string()));
        for (const std::string& method : request.methods)
            series_.emplace(method, Series(report, label, method));
    }

    void run(const ProgressPart& progress) {
        int frames = 0;
        auto still = recording_.stills.begin();
        for (const RecordedImage& image : recording_.video) {
            if (request_.frames > 0 && frames >= request_.frames) break;
            const auto done = static_cast<std::size_t>(frames), all = recording_.video.size();
            progress.show(done, all, frameOf(done, all));
            frame(image);
            ++frames;
            for (; still != recording_.stills.end() && still->time <= image.time; ++still)
                takeStill(*still);
        }
    }

    void addMedians() const {
        for (const auto& [name, series] : series_)
            series.addMedian();
    }

private:
    [[nodiscard]] TrackerOptions trackerOptions() const {
        TrackerOptions out = request_.tracker;
        out.map = map_;
        return out;
    }

    void frame(const RecordedImage& image) {
        const auto truth = recording_.poseAt(image.time);
        const StoredImage picture = loadImage(image.file);
        const auto filtered = tracker_.track(picture.view(), image.time);
        if (!truth) return;
        const double seen = distanceTo(tracker_.detections(), map_, *truth);
        if (seen > 0) distance_ = seen;
        const double ms = tracker_.stats().lastMs;
        add("filtered", image.time, ms, filtered, *truth);
        add("raw", image.time, ms, tracker_.raw(), *truth);
    }

    void takeStill(const RecordedImage& image) {
        const auto truth = recording_.poseAt(image.time);
        if (!truth || !series_.contains("still")) return;
        const StoredImage picture = loadImage(image.file);
        std::optional<Pose> pose;
        const double ms = wallMs([&] { pose = tracker_.trackStill(picture.view(), image.time); });
        add("still", image.time, ms, pose, *truth);
    }

    void add(const std::string& method, Timestamp time, double ms, const std::optional<Pose>& pose,
             const Pose& truth) {
        const auto series = series_.find(method);
        if (series != series_.end()) series->second.add(time, ms, pose, truth, distance_);
    }

    const PoseRequest& request_;
    Recording recording_;
    TagMap map_;
    Tracker tracker_;
    std::map<std::string, Series> series_;
    double distance_ = 0;
};

void evaluatePictures(Report& report, const PoseRequest& request, const fs::path& folder,
                      const std::string& label) {
    int pictures = 0;
    for (const TagPictureFile& picture : tagPicturesOf(folder)) {
        if (request.frames > 0 && pictures++ >= request.frames) break;
        for (const auto& [method, score] : compareTags(picture, request.tracker)) {
            Values row = none();
            row[Ms] = score.ms;
            if (score.found > 0) row[Corner] = score.cornerPx;
            row[Found] = score.found;
            row[Missed] = score.missed;
            row[False] = score.wrong;
            report.add(label, picture.image.stem().string(), method, std::move(row));
        }
    }
}

}  // namespace

const std::vector<std::string>& poseMethodNames() {
    static const std::vector<std::string> names{"filtered", "raw", "still"};
    return names;
}

Report evaluatePose(const PoseRequest& request) {
    Report report(kColumns);
    const auto labels = labelsOf(request.folders);
    std::vector<std::unique_ptr<RecordingRun>> runs;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const fs::path& folder = request.folders[i];
        const ProgressPart progress = request.progress.part(i, labels.size(), labels[i]);
        progress.show(0, 1, "");
        if (fs::is_directory(folder) && !fs::exists(folder / "cam0")) {
            evaluatePictures(report, request, folder, labels[i]);
            continue;
        }
        runs.push_back(std::make_unique<RecordingRun>(report, request, folder, labels[i]));
        runs.back()->run(progress);
    }
    report.addMeans();
    for (const auto& run : runs)
        run->addMedians();
    return report;
}

}  // namespace mfar::eval
