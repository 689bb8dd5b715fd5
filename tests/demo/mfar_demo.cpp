#include "hal/gl_context.h"
#include "hal/virtual/recording.h"
#include "tests/demo/demo_pictures.h"
#include "tests/demo/demo_run.h"
#include "tests/demo/demo_video.h"
#include "tests/eval/picture.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <unistd.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

namespace {

namespace fs = std::filesystem;

using mfar::demo::DemoRun;
using mfar::demo::Quality;

struct Request {
    fs::path recording;
    fs::path folder;
    fs::path video;  ///< Y4M of the daemon, empty: none
};

void showProgress(int done, int all) {
    constexpr int kWidth = 40;
    const int full = kWidth * done / all;
    if (isatty(STDERR_FILENO) == 0 && done != all) return;
    fmt::print(stderr, "\r  [{:=<{}}{: <{}}] {}/{} frames{}", "", full, "", kWidth - full, done,
               all, done == all ? "\n" : "");
}

void printTable(const Quality& q) {
    const auto row = [](const char* what, const std::string& upscaled, const std::string& ours) {
        fmt::print("  {:<34}{:>16}{:>12}\n", what, upscaled, ours);
    };
    fmt::print("\n");
    row(fmt::format("means over {} frames", q.frames).c_str(), "video upscaled", "mfar");
    row("PSNR [dB]", fmt::format("{:.2f}", q.upscaledPsnrDb),
        fmt::format("{:.2f}", q.resultPsnrDb));
    row("SSIM", fmt::format("{:.4f}", q.upscaledSsim), fmt::format("{:.4f}", q.resultSsim));
    row("pixels made worse [%]", "", fmt::format("{:.2f}", 100 * q.harmRate));
    row("confidence", "", fmt::format("{:.3f}", q.meanConfidence));
    row("time of a frame [ms]", "", fmt::format("{:.1f}", q.frameMs));
    for (std::size_t i = 0; i < mfar::kTileClasses; ++i) {
        const auto tileClass = static_cast<mfar::TileClass>(i);
        row(fmt::format("tiles {} [%]", mfar::demo::name(tileClass)).c_str(), "",
            fmt::format("{:.1f}", 100 * q.tileShares[i]));
    }
}

void run(const Request& request) {
    fs::create_directories(request.folder);
    const auto context = mfar::createGlContext();
    const mfar::Recording recording = mfar::loadRecording(request.recording);
    const DemoRun run = mfar::demo::runDemo(recording, showProgress);
    mfar::eval::savePicture(request.folder / "comparison.png",
                            mfar::demo::comparisonPicture(run.last));
    mfar::eval::savePicture(request.folder / "confidence.png",
                            mfar::demo::confidencePicture(run.last));
    mfar::eval::savePicture(request.folder / "tile_classes.png",
                            mfar::demo::tileClassPicture(run.last));
    if (!request.video.empty()) mfar::demo::writeVideo(request.video, request.folder / "video.avi");
    printTable(run.quality);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Shows what the pipeline makes of a recording with truth/highres");
    Request request;
    app.add_option("RECORDING", request.recording, "folder of the recording")->required();
    app.add_option("FOLDER", request.folder, "where the pictures go")->required();
    app.add_option("--video", request.video, "Y4M file that becomes FOLDER/video.avi");
    CLI11_PARSE(app, argc, argv);
    try {
        run(request);
    } catch (const std::exception& e) {
        fmt::print(stderr, "mfar-demo: {}\n", e.what());
        return 1;
    }
    return 0;
}
