#include "pipeline/slices/hole_tracer.h"

#include "pipeline/slices/view_change.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mfar {
namespace {

// Light of the shadow catcher is averaged over pixels up to this distance [px], whose z differs by
// less than this fraction.
constexpr int kReach = 2;
constexpr float kSameDepth = 0.05F;

}  // namespace

void HoleTracer::take(HoleRequest& request) {
    std::swap(request_, request);
    stage_ = Stage::Taken;
}

void HoleTracer::prepare() {
    std::vector<std::uint32_t>& pixels = request_.pixels;
    const RenderView& view = request_.view;
    request_.samples = std::clamp(request_.samples, 1, kMostSamples);
    if (!isUsable(view)) pixels.clear();
    if (pixels.size() > mostPixels_) pixels.resize(mostPixels_);
    std::ranges::sort(pixels);
    const auto twice = std::ranges::unique(pixels);
    pixels.erase(twice.begin(), twice.end());
    const std::uint64_t inside = pixels.empty()
                                     ? 0
                                     : static_cast<std::uint64_t>(view.camera.size.width) *
                                           static_cast<std::uint64_t>(view.camera.size.height);
    while (!pixels.empty() && pixels.back() >= inside)
        pixels.pop_back();
    if (!pixels.empty() && !(film_ && film_->size() == view.camera.size))
        film_.emplace(view.camera.size, memory_);
    if (film_) film_->begin();
    handed_ = done_ = 0;
    stage_ = Stage::Tracing;
}

std::span<const std::uint32_t> HoleTracer::next(std::int64_t mostSamples) {
    const auto most =
        static_cast<std::size_t>(std::max<std::int64_t>(mostSamples / request_.samples, 1));
    const std::size_t count = std::min(most, request_.pixels.size() - handed_);
    const std::span out(request_.pixels.data() + handed_, count);
    handed_ += count;
    return out;
}

LightPixel HoleTracer::catcherLight(std::uint32_t pixel, const Exposure& exposure) const {
    LightPixel out = film_->light(pixel, exposure);
    if (out.id != kCatcherId) return {};
    const auto [width, height] = film_->size();
    const int x = static_cast<int>(pixel) % width, y = static_cast<int>(pixel) / width;
    Eigen::Array3f first{0, 0, 0}, second{0, 0, 0};
    float firsts = 0, seconds = 0;
    for (int v = std::max(y - kReach, 0); v <= std::min(y + kReach, height - 1); ++v)
        for (int u = std::max(x - kReach, 0); u <= std::min(x + kReach, width - 1); ++u) {
            const std::size_t i = static_cast<std::size_t>(v) * width + u;
            if (film_->samples(i) == 0) continue;
            const LightPixel there = film_->light(i, exposure);
            if (there.id != kCatcherId ||
                std::abs(there.depth - out.depth) > kSameDepth * out.depth)
                continue;
            first += there.firstCount * there.first;
            second += there.secondCount * there.second;
            firsts += there.firstCount;
            seconds += there.secondCount;
        }
    if (firsts > 0) out.first = first / firsts;
    if (seconds > 0) out.second = second / seconds;
    return out;
}

// A few samples of a soft shadow are noisy, so pixels that no picture shows are smoothed on the
// shadow catcher. Pixels at edges are not: they are traced anew because they must be sharp.
void HoleTracer::answer(const Exposure& exposure, HoleAnswer& out) {
    out.view = request_.view;
    out.samples = request_.samples;
    out.scene = request_.scene;
    out.edges = request_.edges;
    out.poses = request_.poses;
    out.pixels = request_.pixels;
    out.colour.clear();
    out.depth.clear();
    out.id.clear();
    out.light.clear();
    for (const std::uint32_t pixel : out.pixels) {
        const LightPixel smoothed = request_.edges ? LightPixel{} : catcherLight(pixel, exposure);
        const auto [colour, hit, light] = film_->resolvedFrom(smoothed, pixel, exposure);
        out.colour.push_back(colour);
        out.depth.push_back(hit.depth);
        out.id.push_back(hit.id);
        out.light.push_back(light);
    }
    answered_ += out.pixels.size();
    stage_ = Stage::Idle;
}

}  // namespace mfar
