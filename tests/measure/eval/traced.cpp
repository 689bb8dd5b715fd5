#include "tests/measure/eval/traced.h"

#include "daemon/virtual_world.h"
#include "hal/virtual/image_files.h"
#include "hal/virtual/y4m.h"
#include "pipeline/composite/shadow_catcher.h"
#include "pipeline/scene/scene_parts.h"
#include "pipeline/slices/view_change.h"
#include "pipeline/traced_layer.h"
#include "tests/measure/eval/metrics/flicker.h"
#include "tests/measure/eval/metrics/hdrvdp.h"
#include "tests/measure/eval/scene_key.h"
#include "tests/measure/eval/stopwatch.h"
#include "tests/measure/eval/traced_motion.h"
#include "tests/measure/eval/traced_truth.h"
#include "tests/measure/eval/warp_scenes.h"
#include "tests/warp/warp_engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <thread>

namespace mfar::eval {
namespace {

using Rgb = std::array<float, 3>;
using Picture = std::vector<Rgb>;

constexpr double kRate = 30;
constexpr int kFirstFrames = 15;  // not compared, because the first picture is still being traced
constexpr float kPaper = 200;     // grey level of the background under the layer
constexpr double kFill = 0.5;     // largest side of the objects' bounding box / picture's height
constexpr auto kPatience = std::chrono::seconds(20);
constexpr std::uint64_t kWorldSeed = 1;

/// A scene, and a camera path of the synthetic board around it. The path's target becomes the
/// centre of the objects. Distances are scaled so that the objects fill half the picture's height.
class Course {
public:
    Course(const std::string& scene, synthetic::Path path, Size size)
        : scene_(warpScene(scene)), path_(path),
          world_(synthetic::makeWorld(synthetic::Scene::Office, kWorldSeed)),
          camera_(synthetic::boardRig().video.scaledTo(size)) {
        Eigen::AlignedBox3d box;
        for (const ObjectBall& ball : objectBalls(*scene_)) {
            box.extend(ball.centre + Eigen::Vector3d::Constant(ball.radius));
            box.extend(ball.centre - Eigen::Vector3d::Constant(ball.radius));
        }
        centre_ = box.center();
        const double distance =
            camera_.fy * box.sizes().maxCoeff() / (kFill * static_cast<double>(size.height));
        scale_ = distance / (world_.eye - world_.target).norm();
    }

    [[nodiscard]] const std::shared_ptr<const Scene>& scene() const { return scene_; }
    [[nodiscard]] const CameraModel& camera() const { return camera_; }
    [[nodiscard]] RenderView at(int frame) const {
        RigidTransform pose = synthetic::cameraPose(world_, path_, kWorldSeed, frame / kRate);
        pose.translation = centre_ + scale_ * (pose.translation - world_.target);
        return {camera_, pose};
    }

private:
    std::shared_ptr<const Scene> scene_;
    synthetic::Path path_;
    synthetic::World world_;
    CameraModel camera_;
    Eigen::Vector3d centre_;
    double scale_ = 1;
};

Picture overPaper(const std::uint8_t* rgba, std::size_t pixels) {
    Picture out(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const float paper = kPaper * static_cast<float>(255 - rgba[4 * i + 3]) / 255;
        for (std::size_t c = 0; c < 3; ++c)
            out[i][c] = std::min(255.0F, static_cast<float>(rgba[4 * i + c]) + paper);
    }
    return out;
}

Picture overPaper(const RenderedPicture& picture) {
    return overPaper(picture.colour.front().data(), picture.colour.size());
}

Picture differenceOf(const Picture& a, const Picture& b) {
    Picture out(a.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            out[i][c] = a[i][c] - b[i][c];
    return out;
}

struct MeanSquare {
    double sum = 0;
    double values = 0;

    void add(const Rgb& rgb) {
        for (const float v : rgb)
            sum += static_cast<double>(v) * static_cast<double>(v);
        values += 3;
    }
    [[nodiscard]] std::optional<double> psnr() const {
        if (!(values > 0)) return {};
        return 10 * std::log10(255.0 * 255 * values / std::max(sum, 1e-9));
    }
};
cv::Mat lumaOf(const Picture& error, Size size) {
    cv::Mat out(size.height, size.width, CV_64F);
    double* to = out.ptr<double>();
    for (const Rgb& rgb : error)
        *to++ = 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
    return out;
}

double hdrVdpOf(const Picture& shown, const Picture& exact, Size size) {
    const HdrVdpDisplay display;
    const auto lightOf = [&](const Picture& picture) {
        cv::Mat bgr(size.height, size.width, CV_64FC3);
        auto* to = bgr.ptr<cv::Vec3d>();
        for (const Rgb& rgb : picture)
            *to++ = {rgb[2], rgb[1], rgb[0]};
        return displayedLight(bgr, display);
    };
    return hdrVdp(lightOf(shown), lightOf(exact), display.pixelsPerDegree).q;
}

/// Flicker of the errors of objects' pixels between consecutive frames. Empty if no point of the
/// objects is in both frames.
std::optional<double> flickerOf(const Picture& before, const PosedPicture& truthBefore,
                                const Picture& now, const PosedPicture& truth) {
    const Size size = truth.picture.camera.size;
    const double out =
        flicker(lumaOf(now, size), lumaOf(before, size), motionTo(truthBefore, truth), 0);
    return std::isnan(out) ? std::nullopt : std::optional(out);
}

TracedLayerOptions optionsOf(const TracedRequest& request, const std::string& method) {
    VirtualOptions options;
    options.budgetMs = request.budgetMs;
    TracedLayerOptions out = tracedLayerOptions(options, 1);
    out.size = request.size;
    out.renderer.tracer.independentSamples = method == "independent";
    out.renderer.policy.history = method != "independent";
    return out;
}

Timestamp timeOf(int frame) {
    return Timestamp{} + std::chrono::nanoseconds(std::llround(1e9 * frame / kRate));
}

class ShownFrames {
public:
    ShownFrames(const Course& course, const TracedLayerOptions& options)
        : course_(course), layer_(course.camera(), *engine_, options) {
        layer_.setScene(course.scene());
    }

    /// Returns the next frame. Waits until the tracer's threads have used the budget of the frame,
    /// as on a board with free processors.
    Picture next() {
        const RenderView view = course_.at(frame_);
        const Timestamp time = timeOf(frame_);
        ++frame_;
        layer_.update(view.T_world_camera, time);
        LayerPicture* shown = nullptr;
        warpMs_ = wallMs([&] {
            shown = &layer_.render(view.T_world_camera);
            engine_->finish();
        });
        const Size size = course_.camera().size;
        Picture out(static_cast<std::size_t>(size.width) * size.height, {kPaper, kPaper, kPaper});
        if (!shown->bounds.empty()) {
            const std::vector<std::uint8_t> rgba = test::bytesOf(shown->colour);
            out = overPaper(rgba.data(), rgba.size() / 4);
        }
        waitForThreads();
        if (!firstSeconds_ && counters().render.shown > 0) firstSeconds_ = time.seconds();
        return out;
    }
    /// Time of the frame in which the first traced picture became ready [s].
    [[nodiscard]] std::optional<double> firstSeconds() const { return firstSeconds_; }
    [[nodiscard]] double warpMs() const { return warpMs_; }
    [[nodiscard]] TracedLayerCounters counters() const { return layer_.counters(); }

private:
    void waitForThreads() {
        const auto end = std::chrono::steady_clock::now() + kPatience;
        while (!layer_.rests()) {
            if (std::chrono::steady_clock::now() > end)
                throw EvalError("the path tracer did not finish a frame's work within 20 s; end "
                                "other programs or reduce --budget");
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
        if (const auto error = layer_.takeError()) throw EvalError(*error);
    }

    const Course& course_;
    std::unique_ptr<Engine> engine_ = test::warpEngine();
    TracedLayer layer_;
    int frame_ = 0;
    double warpMs_ = 0;
    std::optional<double> firstSeconds_;
};

void savePicture(const std::filesystem::path& folder, const std::string& name, Size size,
                 const Picture& picture) {
    if (folder.empty()) return;
    std::filesystem::create_directories(folder);
    savePng(folder / (name + ".png"), rgbaOf({&picture}, size).view());
}

/// Name of the files with the truth. It contains the scene's key, because another file, another
/// version of the file or of a built-in scene may have the same name.
std::string truthName(const std::string& name, const Scene& scene, synthetic::Path path) {
    return fmt::format("{}-{:016x}-{}", std::filesystem::path(name).stem().string(),
                       sceneKey(scene), synthetic::name(path));
}

class TracedRun {
public:
    /// `shortName`: name of the scene in the report.
    TracedRun(const TracedRequest& request, const std::string& scene, const std::string& shortName,
              synthetic::Path path, Report& report, const ProgressPart& progress)
        : request_(request), course_(scene, path, request.size), report_(report),
          progress_(progress), label_(fmt::format("{}/{}", shortName, synthetic::name(path))),
          truth_(course_.scene(), request.truthSamples, request.truth,
                 truthName(scene, *course_.scene(), path)) {}

    void run() {
        std::vector<std::vector<Picture>> shown;
        for (std::size_t i = 0; i < request_.methods.size(); ++i)
            shown.push_back(run(request_.methods[i],
                                progress_.part(i, request_.methods.size(), request_.methods[i])));
        if (!request_.video.empty()) writeVideo(shown);
    }

private:
    [[nodiscard]] bool isCompared(int frame) const {
        return frame >= kFirstFrames && frame % request_.every == 0;
    }

    [[nodiscard]] PosedPicture posed(int frame, const RenderedPicture& truth) const {
        return {truth, posesAt(*course_.scene(), timeOf(frame))};
    }

    std::vector<Picture> run(const std::string& method, const ProgressPart& progress) {
        const auto count = static_cast<std::size_t>(request_.frames);
        ShownFrames frames(course_, optionsOf(request_, method));
        std::vector<Picture> all;
        std::optional<Picture> errorBefore;
        const RenderedPicture* truthBefore = nullptr;
        for (int i = 0; i < request_.frames; ++i) {
            const auto done = static_cast<std::size_t>(i);
            progress.show(done, count, frameOf(done, count));
            const Picture shown = frames.next();
            if (!request_.video.empty()) all.push_back(shown);
            const bool follows = i > kFirstFrames && isCompared(i - 1);
            if (!isCompared(i) && !follows) continue;
            const RenderedPicture& truth = truth_.at(i, course_.at(i), timeOf(i));
            const Picture exact = overPaper(truth);
            Picture error = differenceOf(shown, exact);
            std::optional<double> flicker;
            if (follows)
                flicker =
                    flickerOf(*errorBefore, posed(i - 1, *truthBefore), error, posed(i, truth));
            if (isCompared(i))
                compare(method, i, {shown, exact, error, flicker}, truth, frames);
            else if (flicker)
                report_.add(label_, std::to_string(i), method, valuesOf({.flicker = flicker}));
            if (isCompared(i)) {
                const std::string name = fmt::format("{}-{:03}-", fileStem(), i);
                savePicture(request_.save, name + method, request_.size, shown);
                savePicture(request_.save, name + "truth", request_.size, exact);
            }
            errorBefore = std::move(error);
            truthBefore = &truth;
        }
        return all;
    }

    struct Values {
        std::optional<double> psnr{}, shadowPsnr{}, flicker{}, pictures{}, firstSeconds{}, warpMs{},
            hdrVdpQ{};
    };
    [[nodiscard]] std::vector<std::optional<double>> valuesOf(const Values& v) const {
        std::vector<std::optional<double>> out{v.psnr,     v.shadowPsnr,   v.flicker,
                                               v.pictures, v.firstSeconds, v.warpMs};
        if (request_.hdrVdp) out.push_back(v.hdrVdpQ);
        return out;
    }

    struct Compared {
        const Picture &shown, &exact, &error;
        std::optional<double> flicker;
    };
    void compare(const std::string& method, int frame, const Compared& compared,
                 const RenderedPicture& truth, const ShownFrames& frames) {
        MeanSquare object, shadow;
        for (std::size_t i = 0; i < compared.error.size(); ++i) {
            if (showsObject(truth, i))
                object.add(compared.error[i]);
            else if (truth.id[i] == kCatcherId)
                shadow.add(compared.error[i]);
        }
        Values values;
        values.psnr = object.psnr();
        values.shadowPsnr = shadow.psnr();
        values.flicker = compared.flicker;
        values.pictures = static_cast<double>(frames.counters().render.shown);
        values.firstSeconds = frames.firstSeconds();
        values.warpMs = frames.warpMs();
        if (request_.hdrVdp)
            values.hdrVdpQ = hdrVdpOf(compared.shown, compared.exact, request_.size);
        report_.add(label_, std::to_string(frame), method, valuesOf(values));
    }

    [[nodiscard]] std::string fileStem() const { return fileStemOf(label_); }

    void writeVideo(const std::vector<std::vector<Picture>>& shown) const {
        std::filesystem::create_directories(request_.video);
        const Size size{request_.size.width * static_cast<int>(shown.size()), request_.size.height};
        ByteSink sink((request_.video / (fileStem() + ".y4m")).string(), {});
        const std::string header = y4mHeader(size, kRate);
        std::vector<std::uint8_t> bytes(header.begin(), header.end());
        for (std::size_t i = 0; i < shown.front().size(); ++i) {
            std::vector<const Picture*> beside;
            for (const auto& frames : shown)
                beside.push_back(&frames[i]);
            appendY4mFrame(rgbaOf(beside, request_.size).view(), bytes);
            sink.write(bytes);
            bytes.clear();
        }
    }

    const TracedRequest& request_;
    Course course_;
    Report& report_;
    ProgressPart progress_;
    std::string label_;
    TracedTruth truth_;
};

std::vector<Column> tracedColumns(bool hdrVdp) {
    std::vector<Column> out{{"psnr_db", 2},  {"shadow_psnr_db", 2}, {"flicker", 3},
                            {"pictures", 0}, {"first_s", 3},        {"warp_ms", 2}};
    if (hdrVdp) out.push_back({"hdrvdp_q", 2});
    return out;
}

}  // namespace

std::vector<std::string> tracedMethodNames() {
    return {"product", "independent"};
}

Report evaluateTraced(const TracedRequest& request) {
    constexpr int kLeastSide = 17;  // smallest side of pictures for HDR-VDP-2 [px]
    if (request.hdrVdp && std::min(request.size.width, request.size.height) < kLeastSide)
        throw EvalError(
            fmt::format("--hdrvdp needs --width and --height of at least {} px", kLeastSide));
    const int firstScored = (kFirstFrames + request.every - 1) / request.every * request.every;
    if (firstScored >= request.frames)
        throw EvalError(fmt::format("no frame is scored: with --every {}, the first scored frame "
                                    "is {}; --frames must be at least {}",
                                    request.every, firstScored, firstScored + 1));
    Report report(tracedColumns(request.hdrVdp));
    const std::vector<std::string> labels = sceneLabels(request.scenes);
    const std::size_t scenes = request.scenes.size(), paths = request.paths.size();
    for (std::size_t s = 0; s < scenes; ++s)
        for (std::size_t p = 0; p < paths; ++p)
            TracedRun(request, request.scenes[s], labels[s], request.paths[p], report,
                      request.progress.part(s * paths + p, scenes * paths,
                                            fmt::format("{}/{}", request.scenes[s],
                                                        synthetic::name(request.paths[p]))))
                .run();
    report.addMeans();
    return report;
}

}  // namespace mfar::eval
