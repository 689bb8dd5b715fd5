#include "tests/measure/eval/warp.h"

#include "pipeline/warp/warp.h"
#include "tests/measure/eval/picture.h"
#include "tests/measure/eval/stopwatch.h"
#include "tests/measure/eval/warp_scenes.h"
#include "tests/warp/warp_engine.h"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>
#include <opencv2/photo.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>

namespace mfar::eval {
namespace {

// Number of frames in which a view is shown. During these frames, pixels of objects without a
// rendered sample, and pixels at edges, are traced.
constexpr int kFrames = 12;
constexpr double kInpaintRadius = 3;

std::size_t objectPixels(const RenderedPicture& picture) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < picture.id.size(); ++i)
        count += showsObject(picture, i) ? 1 : 0;
    return count;
}

using Rgba = std::vector<std::uint8_t>;

/// PSNR over the three colour channels where the truth shows an object [dB].
double psnrInside(const Rgba& rgba, const RenderedPicture& truth) {
    double sum = 0;
    for (std::size_t i = 0; i < truth.id.size(); ++i)
        for (std::size_t c = 0; c < 3 && showsObject(truth, i); ++c)
            sum += std::pow(rgba[4 * i + c] - truth.colour[i][c], 2);
    const auto values = 3 * static_cast<double>(objectPixels(truth));
    return 10 * std::log10(255.0 * 255 * values / sum);
}

Rgba bytesOf(const RenderedPicture& picture) {
    Rgba out;
    for (const auto& colour : picture.colour)
        out.insert(out.end(), colour.begin(), colour.end());
    return out;
}

struct Shot {
    RenderView view;
    RenderedPicture truth;
};

struct Warped {
    Rgba rgba;
    double ms = 0;
    std::optional<double> holeShare, rerayShare, rerayOfObjects;
};

class WarpRun {
public:
    WarpRun(const WarpRequest& request, const std::string& scene)
        : request_(request), scene_(warpScene(scene)), tracer_(scene_, tracerOptions(false)),
          truth_(scene_, tracerOptions(true)), view_(warpView(*scene_, request.size, 0)),
          picture_(tracePicture(tracer_, view_, request.referenceSamples)),
          reference_(tracedPicture(picture_)) {}

    [[nodiscard]] Shot shoot(double degrees) const {
        const RenderView view = warpView(*scene_, request_.size, degrees);
        return {view, tracePicture(truth_, view, request_.truthSamples)};
    }

    [[nodiscard]] Warped run(const std::string& method, const Shot& shot) const {
        if (method == "full") return full(shot);
        if (method == "inpaint") return inpaint(shot);
        WarpOptions options;
        options.holeSamples = request_.holeSamples;
        options.leastMotion = 0;
        if (method == "none") options.filling = HoleFilling::None;
        if (method == "push-pull") options.filling = HoleFilling::PushPull;
        if (method == "re-render") options.filling = HoleFilling::Rerender;
        Warp warp(view_.camera, request_.size, *engine_, options);
        return ours(warp, shot);
    }

private:
    [[nodiscard]] HoleAnswer answered(const HoleRequest& request) const {
        const RenderedPicture picture =
            tracePixels(tracer_, request.view, request.pixels, request.samples);
        HoleAnswer out{request.view,    request.pixels, {},           {}, {}, {},
                       request.samples, request.scene,  request.edges};
        for (const std::uint32_t pixel : request.pixels) {
            out.colour.push_back(picture.colour[pixel]);
            out.depth.push_back(picture.depth[pixel]);
            out.id.push_back(picture.id[pixel]);
            out.light.push_back(picture.light[pixel]);
        }
        return out;
    }

    [[nodiscard]] Warped ours(Warp& warp, const Shot& shot) const {
        warp.setScene(*scene_);
        warp.setTracedPicture(reference_);
        const auto frame = [&] {
            warp.run(shot.view.T_world_camera);
            engine_->finish();
        };
        Warped out;
        for (int i = 0; i < kFrames; ++i) {
            frame();
            const auto request = warp.takeRequest();
            if (i == 0) out.holeShare = warp.counters().openHoles;
            if (request) warp.answer(answered(*request));
        }
        for (int i = 0; i < WarpOptions{}.fadeFrames; ++i)
            frame();
        out.ms = medianOfThree([&] { return wallMs(frame); });
        out.rgba = test::bytesOf(warp.run(shot.view.T_world_camera).colour);
        const auto pixels = static_cast<double>(objectPixels(shot.truth));
        *out.holeShare /= pixels;
        const auto rays = static_cast<double>(warp.counters().rays) / request_.referenceSamples;
        out.rerayOfObjects = rays / pixels;
        out.rerayShare = rays / static_cast<double>(tracer_.bounds(shot.view).area());
        return out;
    }

    [[nodiscard]] Warped full(const Shot& shot) const {
        Warped out;
        out.ms = wallMs([&] {
            out.rgba = bytesOf(tracePicture(tracer_, shot.view, request_.referenceSamples));
        });
        out.rerayShare = 1;
        return out;
    }

    /// Telea's method for the pixels without a rendered sample. Its time does not include the warp.
    [[nodiscard]] Warped inpaint(const Shot& shot) const {
        Warp warp(view_.camera, request_.size, *engine_,
                  {.filling = HoleFilling::None, .leastMotion = 0});
        Warped out = ours(warp, shot);
        const Rgba state = test::bytesOf(warp.state());
        const cv::Mat rgba(request_.size.height, request_.size.width, CV_8UC4, out.rgba.data());
        cv::Mat rgb, filled;
        cv::cvtColor(rgba, rgb, cv::COLOR_RGBA2RGB);
        cv::Mat1b mask(rgba.size());
        std::size_t i = 0;
        for (std::uint8_t& m : mask)
            m = state[4 * i++ + 1] == 255 ? 255 : 0;
        out.ms = medianOfThree([&] {
            return wallMs(
                [&] { cv::inpaint(rgb, mask, filled, kInpaintRadius, cv::INPAINT_TELEA); });
        });
        out.rerayShare.reset();
        out.rerayOfObjects.reset();
        for (i = 0; i < mask.total(); ++i)
            if (mask(static_cast<int>(i)) != 0)
                std::copy_n(filled.ptr() + 3 * i, 3, out.rgba.begin() + 4 * static_cast<long>(i));
        return out;
    }

    const WarpRequest& request_;
    std::unique_ptr<Engine> engine_ = test::warpEngine();
    std::shared_ptr<const Scene> scene_;
    PathTracer tracer_, truth_;
    RenderView view_;
    RenderedPicture picture_;
    TracedPicture reference_;
};

void saveOnPaper(const WarpRequest& request, const std::string& name, const Rgba& rgba) {
    if (request.save.empty()) return;
    const cv::Mat premultiplied(request.size.height, request.size.width, CV_8UC4,
                                const_cast<std::uint8_t*>(rgba.data()));
    cv::Mat3b out(premultiplied.size());
    constexpr int kPaper = 200;
    for (int y = 0; y < out.rows; ++y)
        for (int x = 0; x < out.cols; ++x) {
            const auto& p = premultiplied.at<cv::Vec4b>(y, x);
            for (int c = 0; c < 3; ++c)
                out(y, x)[2 - c] =
                    cv::saturate_cast<std::uint8_t>(p[c] + kPaper * (255 - p[3]) / 255);
        }
    std::filesystem::create_directories(request.save);
    savePicture(request.save / (name + ".png"), out);
}

}  // namespace

std::vector<std::string> warpMethodNames() {
    return {"none", "push-pull", "re-render", "both", "inpaint", "full"};
}

Report evaluateWarp(const WarpRequest& request) {
    Report report({{"psnr_db", 2},
                   {"hole_share", 4},
                   {"reray_share", 4},
                   {"reray_of_objects", 4},
                   {"ms", 2}});
    const std::vector<std::string> labels = sceneLabels(request.scenes);
    for (std::size_t s = 0; s < request.scenes.size(); ++s) {
        const std::string& scene = request.scenes[s];
        const ProgressPart progress = request.progress.part(s, request.scenes.size(), scene);
        progress.show(0, 1, "");
        const WarpRun run(request, scene);
        for (std::size_t d = 0; d < request.degrees.size(); ++d) {
            const double degrees = request.degrees[d];
            progress.show(d, request.degrees.size(), fmt::format("{:g} degrees", degrees));
            const Shot shot = run.shoot(degrees);
            const std::string label = fmt::format("{}/{:g}", labels[s], degrees);
            const auto fileOf = [&](const std::string& method) {
                return fmt::format("{}-{:g}-{}", fileStemOf(labels[s]), degrees, method);
            };
            saveOnPaper(request, fileOf("truth"), bytesOf(shot.truth));
            for (const std::string& method : request.methods) {
                const Warped warped = run.run(method, shot);
                saveOnPaper(request, fileOf(method), warped.rgba);
                report.add(label, "0", method,
                           {psnrInside(warped.rgba, shot.truth), warped.holeShare,
                            warped.rerayShare, warped.rerayOfObjects, warped.ms});
            }
        }
    }
    return report;
}

}  // namespace mfar::eval
