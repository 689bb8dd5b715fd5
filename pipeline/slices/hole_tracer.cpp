#include "pipeline/slices/hole_tracer.h"

#include "pipeline/slices/view_change.h"

#include <algorithm>
#include <utility>

namespace mfar {

void HoleTracer::take(HoleRequest& request) {
    std::swap(request_, request);
    stage_ = Stage::Taken;
}

void HoleTracer::prepare() {
    std::vector<std::uint32_t>& pixels = request_.pixels;
    const RenderView& view = request_.view;
    request_.samples = std::clamp(request_.samples, 1, kMostHoleSamples);
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
        const auto [colour, hit, light] = film_->resolved(pixel, exposure);
        out.colour.push_back(colour);
        out.depth.push_back(hit.depth);
        out.id.push_back(hit.id);
        out.light.push_back(light);
    }
    answered_ += out.pixels.size();
    stage_ = Stage::Idle;
}

}  // namespace mfar
