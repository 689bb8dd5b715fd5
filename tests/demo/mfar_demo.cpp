#include "base/progress.h"
#include "daemon/config.h"
#include "hal/gl_context.h"
#include "hal/virtual/recording.h"
#include "tests/demo/demo_pictures.h"
#include "tests/demo/demo_run.h"
#include "tests/demo/demo_video.h"
#include "tests/demo/occlusion_pictures.h"
#include "tests/demo/occlusion_run.h"
#include "tests/demo/virtual_run.h"
#include "tests/measure/eval/picture.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace {

namespace fs = std::filesystem;

using mfar::demo::DemoRun;
using mfar::demo::OcclusionQuality;
using mfar::demo::OcclusionRun;
using mfar::demo::Quality;
using mfar::demo::VirtualRun;

// Shares of the whole time at which a part ends, measured on two cores without a GPU.
constexpr double kResolutionEnd = 0.6, kOcclusionEnd = 0.7;

struct Request {
    fs::path recording;
    fs::path folder;
    fs::path video;       ///< Y4M written by the daemon; empty: none
    fs::path objects;     ///< configuration with objects; empty: none
    fs::path pathTraced;  ///< configuration with path-traced objects; empty: none
    std::string scene;    ///< name of the synthetic scene that the recording shows
};

void row(const std::string& what, const std::string& enlarged, const std::string& ours) {
    fmt::print("  {:<36}{:>16}{:>12}\n", what, enlarged, ours);
}

void printTable(const Quality& q, std::string_view engine) {
    fmt::print("\n");
    row(fmt::format("means over {} frames", q.frames), "enlarged video", "mfar");
    row("PSNR [dB]", fmt::format("{:.2f}", q.enlargedPsnrDb),
        fmt::format("{:.2f}", q.resultPsnrDb));
    row("SSIM", fmt::format("{:.4f}", q.enlargedSsim), fmt::format("{:.4f}", q.resultSsim));
    row("pixels worse than enlarged video [%]", "", fmt::format("{:.2f}", 100 * q.harmRate));
    row("mean confidence, 0 to 1", "", fmt::format("{:.3f}", q.meanConfidence));
    row(fmt::format("time of a frame [ms], engine {}", engine), "",
        fmt::format("{:.1f}", q.frameMs));
    for (std::size_t i = 0; i < mfar::kTileClasses; ++i) {
        const auto tileClass = static_cast<mfar::TileClass>(i);
        row(fmt::format("share of tiles: {} [%]", mfar::demo::name(tileClass)), "",
            fmt::format("{:.1f}", 100 * q.tileShares[i]));
    }
    fmt::print(
        "  A tile has 16x16 video pixels. Unchanged: not drawn again. Enlarged: without the\n"
        "  still's detail. Trusted: detail with one weight. Blended: the weight varies.\n");
}

void printTable(const OcclusionQuality& q) {
    fmt::print("\n");
    row(fmt::format("means over {} frames", q.frames), "", "mfar");
    row("median error of depth [%]", "", fmt::format("{:.2f}", 100 * q.absrel));
    row("pixels with known depth [%]", "", fmt::format("{:.1f}", 100 * q.completeness));
    row("IoU of visible object and truth", "", fmt::format("{:.3f}", q.overlap));
    row("error of visible outline [px]", "", fmt::format("{:.2f}", q.boundary));
}

auto shownBy(const mfar::ProgressPart& part) {
    return [part](int done, int all) {
        part.show(static_cast<std::size_t>(done), static_cast<std::size_t>(all),
                  fmt::format("{} of {} frames", done, all));
    };
}

void runObjects(const Request& request, const mfar::Recording& recording, mfar::EngineKind engine,
                const mfar::ProgressPart& part) {
    const auto scene = mfar::synthetic::sceneNamed(request.scene);
    if (!scene)
        throw std::runtime_error("--scene: unknown scene '" + request.scene +
                                 "'; mfar-sim --help lists the scenes");
    const auto objects = mfar::placedShapes(mfar::loadConfig(request.objects).objects, {});
    const OcclusionRun run =
        mfar::demo::runOcclusion(recording, *scene, objects, engine, shownBy(part));
    mfar::eval::savePicture(request.folder / "depth.png", mfar::demo::depthPicture(run));
    mfar::eval::savePicture(request.folder / "occlusion.png", mfar::demo::occlusionPicture(run));
    printTable(run.quality);
}

void runPathTraced(const Request& request, const mfar::Recording& recording,
                   const mfar::ProgressPart& part) {
    if (!mfar::TracedLayer::isAvailable()) {
        fmt::print("virtual.png is not written, because this program was built without the path "
                   "tracer (Debian: libembree-dev).\n");
        return;
    }
    const VirtualRun run =
        mfar::demo::runVirtual(recording, mfar::loadConfig(request.pathTraced), shownBy(part));
    mfar::eval::savePicture(request.folder / "virtual.png", mfar::demo::virtualPicture(run));
    fmt::print("\n");
    row("path-tracer samples during motion", "", fmt::format("{}", run.moved.render.samples));
    row("path-tracer samples in total", "", fmt::format("{}", run.rested.render.samples));
    row("frames with a warped picture", "", fmt::format("{}", run.rested.warped));
    row("pixels traced individually", "", fmt::format("{}", run.rested.answered));
}

void run(const Request& request) {
    fs::create_directories(request.folder);
    const auto context = mfar::createGlContext();
    const mfar::Recording recording = mfar::loadRecording(request.recording);
    mfar::Progress progress;
    const mfar::ProgressPart all(progress);
    // mfard measures which assignment of steps to engines is fastest. Here, one engine runs all
    // steps.
    const mfar::EngineKind engine =
        context->isSoftware() ? mfar::EngineKind::Simd : mfar::EngineKind::Gles;
    const DemoRun run =
        mfar::demo::runDemo(recording, engine, shownBy(all.span(0, kResolutionEnd, "resolution")));
    mfar::eval::savePicture(request.folder / "comparison.png",
                            mfar::demo::comparisonPicture(run.last));
    mfar::eval::savePicture(request.folder / "confidence.png",
                            mfar::demo::confidencePicture(run.last));
    mfar::eval::savePicture(request.folder / "tile_classes.png",
                            mfar::demo::tileClassPicture(run.last));
    if (!request.video.empty()) mfar::demo::writeVideo(request.video, request.folder / "video.avi");
    progress.clear();
    printTable(run.quality, nameOf(engine));
    if (!request.objects.empty())
        runObjects(request, recording, engine,
                   all.span(kResolutionEnd, kOcclusionEnd, "occlusion"));
    progress.clear();
    if (!request.pathTraced.empty())
        runPathTraced(request, recording, all.span(kOcclusionEnd, 1, "path tracing"));
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Draws pictures of the pipeline's results. RECORDING needs true pictures in truth/highres");
    Request request;
    app.add_option("RECORDING", request.recording, "folder of the recording")->required();
    app.add_option("FOLDER", request.folder, "folder to write the pictures into")->required();
    app.add_option("--video", request.video, "Y4M file to convert into FOLDER/video.avi");
    auto* scene =
        app.add_option("--scene", request.scene, "synthetic scene of mfar-sim that was recorded");
    app.add_option("--objects", request.objects,
                   "configuration file whose [[objects]] are drawn into the recording")
        ->needs(scene);
    app.add_option("--virtual", request.pathTraced,
                   "configuration file whose [[objects]] are path traced into the recording");
    CLI11_PARSE(app, argc, argv);
    try {
        run(request);
    } catch (const std::exception& e) {
        fmt::print(stderr, "mfar-demo: {}\n", e.what());
        return 1;
    }
    return 0;
}
