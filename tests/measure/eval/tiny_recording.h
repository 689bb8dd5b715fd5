#pragma once

#include "hal/virtual/image_files.h"
#include "hal/virtual/recorder.h"
#include "tests/measure/bench/workload.h"
#include "tests/measure/eval/picture.h"
#include "tests/unit/run_program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace mfar::eval {

inline std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> out;
    std::istringstream in(line + ",");
    for (std::string field; std::getline(in, field, ',');)
        out.push_back(field);
    return out;
}

inline std::vector<std::vector<std::string>> readCsv(const std::filesystem::path& file) {
    std::vector<std::vector<std::string>> out;
    std::istringstream in(test::readFile(file));
    for (std::string line; std::getline(in, line);)
        out.push_back(split(line));
    return out;
}

/// Writes video frames and a still of a synthetic scene. If `withTruth` is true, enlarged frames
/// serve as the true pictures (truth/highres).
inline void writeRecording(const std::filesystem::path& root, bool withTruth, int frames = 2) {
    const bench::Workload work = bench::syntheticWorkload({160, 120}, {576, 432}, frames);
    Recorder recorder(root, work.rig, 30);
    const cv::Mat still = toRgba(work.stills[0]);
    ASSERT_TRUE(recorder.still(viewOf(still), {500}));
    for (std::size_t i = 0; i < work.frames.size(); ++i) {
        const Timestamp time{static_cast<std::int64_t>(1000 + i)};
        const cv::Mat frame = toRgba(work.frames[i]);
        ASSERT_TRUE(recorder.video(viewOf(frame), time));
        if (!withTruth) continue;
        cv::Mat truth;
        cv::resize(frame, truth, {576, 432}, 0, 0, cv::INTER_LANCZOS4);
        std::filesystem::create_directories(root / "truth" / "highres");
        savePng(root / "truth" / "highres" / fmt::format("{}.png", time.ns), viewOf(truth));
    }
    recorder.finish();
}

}  // namespace mfar::eval
