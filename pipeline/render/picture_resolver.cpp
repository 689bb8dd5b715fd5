#include "pipeline/render/picture_resolver.h"

#include <algorithm>
#include <numeric>

namespace mfar {
namespace {

// Number of pixels by which Film::prefetch() runs ahead of reading.
constexpr int kAhead = 4;

}  // namespace

void PictureResolver::begin(const Film& film, const RenderView& view, const PixelRect& traced,
                            const Exposure& exposure, bool filter, RenderedPicture& out,
                            bool layered) {
    const Size size = film.size();
    film_ = &film;
    traced_ = common(traced, {0, 0, size.width, size.height});
    if (traced_.empty()) traced_ = {};
    exposure_ = exposure;
    filters_ = filter;
    out_ = &out;
    out.camera = view.camera;
    out.T_world_camera = view.T_world_camera;
    reserve(size, filter, out);
    out.exposure = exposure.scale;
    out.layered = filter && layered;
    taken_.assign(static_cast<std::size_t>(size.height), 0);
    seen_ = taken_;
    if (filters_) filter_.begin(size, traced_, view.camera.fx);
    stage_ = filters_ && !traced_.empty() ? kPrepare : kLastStage;
    nextRow_ = rowsBegin();
    rowsOut_ = 0;
}

void PictureResolver::reserve(Size size, bool filter, RenderedPicture& out) {
    const std::size_t pixels =
        static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
    out.colour.resize(pixels);
    out.depth.resize(pixels);
    out.id.resize(pixels);
    out.light.resize(pixels);
    out.gloss.resize(pixels);
    if (filter) filter_.reserve(size);
}

// The last stage also clears pixels outside `traced_`, where `out_` still holds an earlier picture.
int PictureResolver::rowsBegin() const {
    return stage_ == kLastStage ? 0 : traced_.y0;
}

int PictureResolver::rowsEnd() const {
    if (complete()) return nextRow_;
    return stage_ == kLastStage ? film_->size().height : traced_.y1;
}

PictureResolver::Portion PictureResolver::next(std::int64_t pixels) {
    const std::int64_t width = std::max(traced_.x1 - traced_.x0, 1);
    const auto rows = static_cast<int>(
        std::clamp<std::int64_t>(pixels / width, 1, std::max(rowsEnd() - nextRow_, 1)));
    const Portion out{stage_, nextRow_, std::min(nextRow_ + rows, rowsEnd())};
    nextRow_ = out.lastRow;
    rowsOut_ += out.lastRow - out.firstRow;
    return out;
}

std::int64_t PictureResolver::pixelsOf(const Portion& portion) const {
    return std::int64_t{portion.lastRow - portion.firstRow} * std::max(traced_.x1 - traced_.x0, 1);
}

void PictureResolver::run(const Portion& portion) {
    if (portion.stage > kPrepare && portion.stage < kLastStage)
        return filter_.run(portion.stage - 1, portion.firstRow, portion.lastRow);
    for (int row = portion.firstRow; row < portion.lastRow; ++row)
        portion.stage == kPrepare ? prepare(row) : write(row);
}

void PictureResolver::done(const Portion& portion) {
    rowsOut_ -= portion.lastRow - portion.firstRow;
    if (rowsOut_ > 0 || hasNext()) return;
    ++stage_;
    nextRow_ = complete() ? 0 : rowsBegin();
    if (!complete()) return;
    const double seen = std::reduce(seen_.begin(), seen_.end());
    out_->samples = seen > 0 ? std::reduce(taken_.begin(), taken_.end()) / seen : 0;
}

void PictureResolver::prepare(int row) {
    const auto begin = static_cast<std::size_t>(row) * film_->size().width;
    for (int x = traced_.x0; x < traced_.x1; ++x) {
        const std::size_t i = begin + x;
        if (x + kAhead < traced_.x1) film_->prefetch(i + kAhead);
        if (isTraced(i))
            filter_.pixels()[i] = film_->light(i, exposure_);
        else
            filter_.pixels()[i].id = 0;
    }
}

void PictureResolver::write(int row) {
    const int width = film_->size().width;
    const auto begin = static_cast<std::size_t>(row) * width;
    std::fill_n(out_->colour.begin() + static_cast<std::ptrdiff_t>(begin), width,
                std::array<std::uint8_t, 4>{});
    std::fill_n(out_->depth.begin() + static_cast<std::ptrdiff_t>(begin), width, 0.0F);
    std::fill_n(out_->id.begin() + static_cast<std::ptrdiff_t>(begin), width, std::uint8_t{0});
    std::fill_n(out_->light.begin() + static_cast<std::ptrdiff_t>(begin), width, LightWords{});
    std::fill_n(out_->gloss.begin() + static_cast<std::ptrdiff_t>(begin), width, GlossWords{});
    if (row < traced_.y0 || row >= traced_.y1) return;
    for (int x = traced_.x0; x < traced_.x1; ++x) {
        const std::size_t i = begin + x;
        if (x + kAhead < traced_.x1) film_->prefetch(i + kAhead);
        const auto [colour, hit, onObject] =
            filters_ ? filtered(x, row) : film_->resolved(i, exposure_);
        out_->colour[i] = colour;
        out_->depth[i] = hit.depth;
        out_->light[i] = onObject;
        out_->id[i] = hit.id;
        if (hit.id == 0) continue;
        if (hit.id != kCatcherId) out_->gloss[i] = film_->gloss(i);
        taken_[static_cast<std::size_t>(row)] += film_->samples(i);
        seen_[static_cast<std::size_t>(row)] += 1;
    }
}

Film::Resolved PictureResolver::filtered(int x, int y) const {
    const std::size_t i = static_cast<std::size_t>(y) * film_->size().width + x;
    if (isTraced(i)) return film_->resolvedFrom(filter_.filtered()[i], i, exposure_, out_->layered);
    const LightPixel light = between(x, y);
    Film::Resolved out = film_->resolvedFrom(light, i, exposure_, true);
    if (out.colour != std::array<std::uint8_t, 4>{}) out.hit = {light.depth, light.id};
    return out;
}

// Returns the mean of the neighbours of (x, y) with even column and even row that show the shadow
// catcher.
LightPixel PictureResolver::between(int x, int y) const {
    LightPixel out;
    float count = 0, perDepth = 0;
    for (const int v : {y - y % 2, y + y % 2})
        for (const int u : {x - x % 2, x + x % 2}) {
            if (u < traced_.x0 || u >= traced_.x1 || v < traced_.y0 || v >= traced_.y1) continue;
            const LightPixel& p =
                filter_.filtered()[static_cast<std::size_t>(v) * film_->size().width + u];
            if (p.id != kCatcherId) continue;
            out.first += p.first;
            out.second += p.second;
            out.firstVariance += p.firstVariance;
            out.secondVariance += p.secondVariance;
            out.firstCount += p.firstCount;
            out.secondCount += p.secondCount;
            out.normal = p.normal;
            perDepth += 1 / p.depth;
            ++count;
        }
    if (!(count > 0)) return out;
    out.first /= count;
    out.second /= count;
    out.firstVariance /= count;
    out.secondVariance /= count;
    out.firstCount /= count;
    out.secondCount /= count;
    out.depth = count / perDepth;
    out.id = kCatcherId;
    return out;
}

void resolve(const Film& film, const RenderView& view, const Exposure& exposure,
             RenderedPicture& out, bool filter) {
    PictureResolver resolver;
    resolver.begin(film, view, {0, 0, film.size().width, film.size().height}, exposure, filter,
                   out);
    while (!resolver.complete()) {
        const PictureResolver::Portion portion = resolver.next(1 << 30);
        resolver.run(portion);
        resolver.done(portion);
    }
}

}  // namespace mfar
