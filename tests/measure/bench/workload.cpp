#include "tests/measure/bench/workload.h"

#include "hal/virtual/recording.h"
#include "tests/measure/eval/picture.h"
#include "tests/measure/eval/report.h"
#include "tests/measure/eval/shot.h"
#include "tests/measure/eval/still_choice.h"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>

namespace mfar::bench {
namespace {

constexpr double kVideoNoise = 1.5;  // standard deviation for a good sensor indoors [grey levels]
constexpr int kLessonEvery = 10;     // at most every tenth frame becomes a lesson

cv::Mat texture(cv::Size size) {
    cv::RNG random(20);
    cv::Mat sum(size, CV_32FC3, cv::Scalar::all(20));
    for (const int cell : {2, 7, 25, 90}) {
        cv::Mat coarse(size.height / cell + 2, size.width / cell + 2, CV_32FC3), fine;
        random.fill(coarse, cv::RNG::UNIFORM, 0, 45);
        cv::resize(coarse, fine, {coarse.cols * cell, coarse.rows * cell}, 0, 0, cv::INTER_LINEAR);
        sum += fine(cv::Rect({0, 0}, size));
    }
    for (int i = 0; i < 600; ++i) {
        const cv::Point at(random.uniform(0, size.width), random.uniform(0, size.height));
        const cv::Size bar(random.uniform(3, 60), random.uniform(3, 20));
        cv::rectangle(sum, cv::Rect(at, bar), cv::Scalar::all(random.uniform(10, 245)), cv::FILLED);
    }
    cv::Mat out;
    sum.convertTo(out, CV_8U);
    return out;
}

cv::Mat viewAt(const cv::Mat& world, cv::Size size, double k) {
    const double dx = 0.015 * size.width * std::sin(0.45 * k);
    const double dy = 0.010 * size.width * std::sin(0.31 * k + 1);
    const cv::Point2f middle(static_cast<float>(world.cols - 1) / 2,
                             static_cast<float>(world.rows - 1) / 2);
    cv::Mat motion = cv::getRotationMatrix2D(middle, 0.6 * std::sin(0.23 * k), 1);
    motion.at<double>(0, 2) += dx - (world.cols - size.width) / 2.0;
    motion.at<double>(1, 2) += dy - (world.rows - size.height) / 2.0;
    cv::Mat out;
    cv::warpAffine(world, out, motion, size, cv::INTER_LINEAR, cv::BORDER_REFLECT);
    return out;
}

cv::Mat withNoise(const cv::Mat& picture, double sigma, std::uint64_t seed) {
    cv::Mat values, noise(picture.size(), CV_32FC3), out;
    cv::RNG(seed + 1).fill(noise, cv::RNG::NORMAL, 0, sigma);
    picture.convertTo(values, CV_32F);
    values += noise;
    values.convertTo(out, CV_8U);
    return out;
}

cv::Mat pictureOf(const Frame& frame, Size size) {
    const ImageView& view = frame.view();
    const cv::Mat rgba(view.size.height, view.size.width, CV_8UC4,
                       const_cast<std::uint8_t*>(view.data), view.stride);
    cv::Mat out;
    cv::cvtColor(rgba, out, cv::COLOR_RGBA2BGR);
    if (!(view.size == size)) cv::resize(out, out, {size.width, size.height}, 0, 0, cv::INTER_AREA);
    return out;
}

StereoRig sameLens(Size video, Size still) {
    CameraModel camera;
    camera.size = video;
    camera.fx = camera.fy = 0.85 * video.width;
    camera.cx = (video.width - 1) / 2.0;
    camera.cy = (video.height - 1) / 2.0;
    return {camera, camera.scaledTo(still), {}};
}

}  // namespace

Workload syntheticWorkload(Size video, Size still, int frames, int lessons) {
    const cv::Size stillSize(still.width, still.height), videoSize(video.width, video.height);
    const cv::Mat world = texture({still.width * 11 / 10, still.height * 11 / 10});
    Workload out{"synthetic", sameLens(video, still), {viewAt(world, stillSize, -2)}, {}, {}, {},
                 {}};
    const auto frameAt = [&](int k) {
        cv::Mat frame;
        cv::resize(viewAt(world, stillSize, k), frame, videoSize, 0, 0, cv::INTER_AREA);
        return withNoise(frame, kVideoNoise, static_cast<std::uint64_t>(k));
    };
    for (int k = -kLessonEvery * lessons; k < 0; k += kLessonEvery)
        out.lessons.push_back({viewAt(world, stillSize, k - 2), frameAt(k)});
    if (lessons > 0) out.before = out.lessons.back();
    for (int k = 0; k < frames; ++k) {
        out.frames.push_back(frameAt(k));
        out.stillOf.push_back(0);
    }
    return out;
}

SyntheticOptions handheldOptions(synthetic::Scene scene, Size video, Size still) {
    SyntheticOptions out;
    out.scene = scene;
    out.path = synthetic::Path::Handheld;
    out.pace = Pace::Consumer;
    out.rig = synthetic::boardRig(video, still);
    return out;
}

Workload handheldWorkload(Size video, Size still, int frames, int lessons) {
    SyntheticBoard board(handheldOptions(synthetic::Scene::Office, video, still));
    Workload out = handheldWorkload(board, video, still, frames, lessons);
    out.name = "office, hand-held";
    return out;
}

Workload handheldWorkload(SyntheticBoard& board, Size video, Size still, int frames, int lessons) {
    const StereoRig& rig = board.rig();
    Workload out{};
    out.name = "synthetic board";
    out.rig = {rig.video.scaledTo(video), rig.still.scaledTo(still), rig.T_still_video};
    board.video().start();
    board.stills().start();
    const auto nextFrame = [&] {
        auto frame = board.video().next(std::chrono::seconds(1));
        if (!frame) throw std::runtime_error("the synthetic board has stopped");
        return std::move(*frame);
    };
    const auto nextStill = [&] {
        board.trigger().fire();
        for (;;) {
            (void)nextFrame();
            if (auto taken = board.stills().next(std::chrono::milliseconds(0)))
                return std::move(*taken);
        }
    };
    for (int lesson = 0; lesson < lessons; ++lesson) {
        const Frame taken = nextStill(), frame = nextFrame();
        out.lessons.push_back({pictureOf(taken, still), pictureOf(frame, video),
                               board.pose(taken.time()), board.pose(frame.time())});
        for (int i = 1; i < kLessonEvery; ++i)
            (void)nextFrame();
    }
    if (lessons > 0) out.before = out.lessons.back();
    const Frame taken = nextStill();
    out.stills.push_back(pictureOf(taken, still));
    out.stillPoses.emplace_back(board.pose(taken.time()));
    while (out.frames.size() < static_cast<std::size_t>(frames)) {
        const Frame frame = nextFrame();
        out.frames.push_back(pictureOf(frame, video));
        out.framePoses.emplace_back(board.pose(frame.time()));
        out.stillOf.push_back(0);
    }
    return out;
}

Workload recordedWorkload(const std::filesystem::path& folder, int frames) {
    const Recording recording = loadRecording(folder);
    Workload out{folder.string(), recording.rig, {}, {}, {}, {}, {}};
    std::map<std::size_t, std::size_t> loaded;
    const auto distinct =
        std::min<std::size_t>(static_cast<std::size_t>(frames), recording.video.size());
    for (std::size_t i = 0; i < distinct; ++i) {
        const auto still = eval::referenceStill(recording, recording.video[i].time);
        if (!still)
            throw eval::EvalError(
                fmt::format("{}: frame {} cannot be measured: every still was taken from the same "
                            "pose as the frame, or the recording has no stills",
                            folder.string(), recording.video[i].time.ns));
        const RecordedImage& reference = recording.stills[*still];
        const auto poses = eval::posesOf(recording, recording.video[i].time, reference.time);
        out.framePoses.push_back(poses.frame);
        out.frames.push_back(eval::loadPicture(recording.video[i].file));
        if (loaded.emplace(*still, out.stills.size()).second) {
            out.stills.push_back(eval::loadPicture(reference.file));
            out.stillPoses.push_back(poses.still);
            out.lessons.push_back({out.stills.back(), out.frames.back(), poses.still, poses.frame});
            if (out.stills.size() > 1) out.before = out.lessons.back();
        }
        out.stillOf.push_back(loaded.at(*still));
    }
    for (std::size_t i = distinct; i < static_cast<std::size_t>(frames); ++i) {
        out.frames.push_back(out.frames[i % distinct]);
        out.stillOf.push_back(out.stillOf[i % distinct]);
        out.framePoses.push_back(out.framePoses[i % distinct]);
    }
    return out;
}

Workload atRest(const Workload& moving, double noise) {
    Workload out = moving;
    for (std::size_t i = 0; i < out.frames.size(); ++i) {
        out.frames[i] = noise > 0 ? withNoise(moving.frames[0], noise, i) : moving.frames[0];
        out.stillOf[i] = moving.stillOf[0];
        if (!out.framePoses.empty()) out.framePoses[i] = moving.framePoses[0];
    }
    return out;
}

}  // namespace mfar::bench
