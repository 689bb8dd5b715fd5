#include "pipeline/warp/warp.h"

#include "base/se3.h"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

namespace mfar {
namespace {

// The camera rests after this number of frames without motion.
constexpr int kRestFrames = 5;
// Motions below this limit [px] count as no motion. Equal poses may differ by rounding errors.
constexpr double kSamePose = 1e-3;

WarpOptions validated(const WarpOptions& options) {
    validate(options);
    return options;
}

/// Rank of a pixel in a 4x4 pattern whose lowest ranks are evenly spread (Bayer 1973).
unsigned orderOf(std::uint32_t pixel, unsigned width) {
    const unsigned x = pixel % width, y = pixel / width, d = x ^ y;
    return (d & 1) << 3 | (x & 1) << 2 | (d & 2) | (x & 2) >> 1;
}

/// Keeps at most `most` pixels, evenly spread. Sorts them only if it removes some.
void thinOut(std::vector<std::uint32_t>& pixels, std::size_t most, unsigned width) {
    if (pixels.size() <= most) return;
    std::ranges::sort(pixels, {}, [&](std::uint32_t p) { return std::pair(orderOf(p, width), p); });
    std::size_t whole = most;
    while (whole > 0 && orderOf(pixels[whole - 1], width) == orderOf(pixels[most], width))
        --whole;
    const auto last = std::span(pixels).subspan(whole);
    const auto same = static_cast<std::size_t>(std::ranges::count_if(
        last, [&](std::uint32_t p) { return orderOf(p, width) == orderOf(pixels[most], width); }));
    for (std::size_t i = 0; i < most - whole; ++i)
        pixels[whole + i] = pixels[whole + i * same / (most - whole)];
    pixels.resize(most);
    std::ranges::sort(pixels);
}

}  // namespace

Warp::Warp(const CameraModel& video, Size output, Engine& engine, const WarpOptions& options)
    : lens_(video.scaledTo(output)), options_(validated(options)),
      step_(engine.warp(lens_.camera, options_)) {}

void Warp::setScene(const Scene& scene) {
    ++scene_;
    step_->setScene(scene);
    asked_ = false;
    dropTracedPicture();
}

void Warp::setTracedPicture(TracedPicture traced) {
    dropTracedPicture();
    traced_ = std::move(traced);
    step_->setTracedPicture(*traced_);
}

// Keeps re-rendered pictures, because they stay valid until the scene changes.
void Warp::dropTracedPicture() {
    traced_.reset();
    requested_ = {};
    step_->dropHoles();
    rested({});
}

LayerPicture& Warp::run(const RigidTransform& T_world_camera, std::vector<RigidTransform> poses) {
    PixelRect bounds;
    WarpMotion motion;
    poses_ = std::move(poses);
    if (traced_ && isFinite(T_world_camera)) {
        if (!poses_.empty()) step_->setPoses(poses_);
        motion = motionOf(*traced_, lens_, T_world_camera);
        bounds = around(step_->bounds(T_world_camera), motion.bounds);
    }
    if (bounds.empty()) {
        ++counters_.empty;
        rested({});
        return nothing_;
    }
    if (!traced_->tiles.empty() && !traced_->layered && poses_.empty() &&
        motion.greatest < options_.leastMotion) {
        ++counters_.unmoved;
        rested({});
        return step_->traced();
    }
    ++counters_.warped;
    rested(T_world_camera);
    const bool lists = !asked_ && !step_->holesPending();
    if (lists) {
        listPose_ = T_world_camera;
        listPoses_ = poses_;
    }
    return step_->run({T_world_camera, bounds, lists});
}

void Warp::rested(const std::optional<RigidTransform>& T_world_camera) {
    if (T_world_camera && warpedTo_ && poses_.empty() && isUnmoved(*warpedTo_, *T_world_camera))
        return;
    warpedTo_ = T_world_camera;
    restFrames_ = 0;
    step_->dropEdges();
}

std::optional<HoleRequest> Warp::takeRequest() {
    if (asked_ || !traced_) return {};
    auto out = takeHoles();
    return out ? std::move(out) : takeEdges();
}

std::optional<HoleRequest> Warp::takeHoles() {
    auto holes = step_->takeHoles();
    if (!holes) return {};
    counters_.openHoles = static_cast<int>(holes->open.size());
    counters_.cracks = holes->cracks;
    if (!rerenders(options_.filling)) return {};
    dropRefused(holes->open);
    return request(std::move(holes->open), false, listPose_);
}

std::optional<HoleRequest> Warp::takeEdges() {
    if (!warpedTo_) return {};
    if (!poses_.empty()) return {};
    if (restFrames_ <= kRestFrames && ++restFrames_ > kRestFrames) step_->listEdges();
    auto edges = step_->takeEdges();
    return edges ? request(std::move(*edges), true, *warpedTo_) : std::nullopt;
}

std::optional<HoleRequest> Warp::request(std::vector<std::uint32_t> pixels, bool edges,
                                         const RigidTransform& T_world_camera) {
    if (pixels.empty()) return {};
    thinOut(pixels, static_cast<std::size_t>(options_.mostRequested),
            static_cast<unsigned>(lens_.camera.size.width));
    const int samples = edges ? options_.sharpenSamples : options_.holeSamples;
    counters_.requested += pixels.size();
    counters_.rays += pixels.size() * static_cast<unsigned>(samples);
    asked_ = true;
    HoleRequest out{{lens_.camera, T_world_camera}, std::move(pixels), samples, scene_, edges};
    if (!edges) {
        out.poses = listPoses_;
        remember(out);
    }
    return out;
}

/// True if the requested pixels belong to the view of the frame whose missing pixels are listed.
bool Warp::isOfRequested() const {
    return listPoses_.empty() && isUnmoved(requested_.T_world_camera, listPose_);
}

void Warp::remember(const HoleRequest& request) {
    if (!isOfRequested()) requested_ = {request.view.T_world_camera, {}};
    requested_.pixels.push_back(request.pixels);
    if (requested_.pixels.size() > RerenderedPictures::kPictures)
        requested_.pixels.erase(requested_.pixels.begin());
}

/// True if each point of the traced picture moves by less than leastMotion or kSamePose [px],
/// whichever is larger. The motion is estimated for a point at the picture's centre, with the
/// least depth of all points.
bool Warp::isUnmoved(const RigidTransform& from, const RigidTransform& to) const {
    const RigidTransform T = from.inverse() * to;
    float nearest = kFarthestSurface;
    for (const TracedPicture::Tile& tile : traced_->tiles)
        nearest = std::min(nearest, tile.nearest);
    const double turn = 2 * T.rotation.vec().norm();
    return lens_.camera.fx * (turn + T.translation.norm() / nearest) <
           std::max(options_.leastMotion, kSamePose);
}

// Removes pixels that were already requested for this view. These pixels were rendered but are
// missing again, so rendering them once more would not help.
void Warp::dropRefused(std::vector<std::uint32_t>& pixels) const {
    if (!isOfRequested()) return;
    std::erase_if(pixels, [&](std::uint32_t p) {
        return std::ranges::any_of(requested_.pixels, [&](const auto& request) {
            return std::ranges::binary_search(request, p);
        });
    });
}

void Warp::answer(const HoleAnswer& answer) {
    const auto& pixels = answer.pixels;
    const Size size = lens_.camera.size;
    const std::size_t count = static_cast<std::size_t>(size.width) * size.height;
    if (answer.colour.size() != pixels.size() || answer.depth.size() != pixels.size() ||
        answer.id.size() != pixels.size() ||
        (!answer.light.empty() && answer.light.size() != pixels.size()))
        throw std::invalid_argument("individually rendered pixels must each have a colour, a depth "
                                    "and an id, and either all or none of them a light");
    if (std::ranges::any_of(pixels, [&](std::uint32_t p) { return p >= count; }))
        throw std::invalid_argument("an individually rendered pixel is outside the layer");
    if (!isFinite(answer.view.T_world_camera))
        throw std::invalid_argument("individually rendered pixels: the camera pose is not finite");
    if (answer.scene != scene_) return;
    asked_ = false;
    if (pixels.empty()) return;
    counters_.answered += pixels.size();
    if (!answer.edges)
        step_->addRerendered(answer);
    else if (warpedTo_ && isUnmoved(answer.view.T_world_camera, *warpedTo_))
        step_->answerEdges(answer);
}

}  // namespace mfar
