#include "pipeline/simd/occlusion_step.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

namespace mfar::simd {
namespace {

// Number of entries after the last pixel in Strip's arrays. Vectors write into them.
constexpr int kSpare = 64;

Size withMargin(Size video) {
    return {video.width + 2 * kSampleMargin, video.height};
}

/// Returns the weights of the four depth samples around an output pixel along one axis. `share`:
/// distance from the second sample to the pixel [sample spacings].
std::array<float, 4> distanceWeights(float share) {
    std::array<float, 4> out{};
    for (int i = 0; i < 4; ++i) {
        const float tent = 2 - std::abs(static_cast<float>(i - 1) - share);
        out[static_cast<std::size_t>(i)] = tent * tent;
    }
    return out;
}

void repeatBorder(float* row, int width) {
    std::fill_n(row, kSampleMargin, row[kSampleMargin]);
    std::fill_n(row + kSampleMargin + width, kSampleMargin, row[kSampleMargin + width - 1]);
}

}  // namespace

struct OcclusionStep::Task {
    const LayerRowsView& layer;
    const RealDepth& real;
    const RgbPlanes& video;
    Rows<std::uint32_t> picture;
    PixelRect bounds;
    int first, last;  // columns [first, last) of the video that the pixels in `bounds` read
};

/// Temporary values for `count` pixels of an output row, from column `x` on. `greatest` and `least`
/// (see rangeOfSamples()) are the same for all output rows between two video rows.
struct OcclusionStep::Strip {
    int x = 0, count = 0;
    std::array<float, kVisibilityChunk + kSpare> greatest{}, least{}, z{}, inverse{};
    std::array<std::uint32_t, kVisibilityChunk + kSpare> colours{};
    // Used only if the layer's size differs from the output's: depths and colours of the layer's
    // rows above and below the strip, and colours interpolated between these rows (redBlue,
    // greenAlpha).
    std::array<float, kVisibilityChunk + kSpare> depthAbove{}, depthBelow{};
    std::array<std::uint32_t, kVisibilityChunk + kSpare> above{}, below{}, redBlue{}, greenAlpha{};
    std::array<std::uint8_t, kVisibilityChunk + kSpare> visibility{};
};

OcclusionStep::Between::Between(int pixels, int others) {
    for (int i = 0; i < pixels; ++i) {
        const double at = (i + 0.5) * others / pixels - 0.5;
        first.push_back(static_cast<std::int32_t>(std::floor(at)));
        share.push_back(static_cast<float>(at - std::floor(at)));
    }
}

OcclusionStep::OcclusionStep(Size video, Size output, Size layer, const CompositeOptions& options,
                             std::shared_ptr<Workers> workers)
    : video_(video), output_(output), layer_(layer), options_(options), params_(options),
      workers_(std::move(workers)), columns_(output.width, video.width),
      rows_(output.height, video.height), layerColumns_(output.width, layer.width),
      layerRows_(output.height, layer.height), inverse_(withMargin(video)),
      variance_(withMargin(video)), red_(withMargin(video)), green_(withMargin(video)),
      blue_(withMargin(video)), nearest_(withMargin(video)), farthest_(withMargin(video)),
      greatest_({withMargin(video).width, video.height + 1}),
      least_({withMargin(video).width, video.height + 1}), visibility_(output) {
    validate(options);
    // Strip's arrays also store the columns of the layer that a strip reads. So a strip must not
    // read more columns than these arrays can store.
    const double columnsPerPixel = static_cast<double>(layer.width) / output.width;
    longestStrip_ =
        std::clamp(static_cast<int>((kVisibilityChunk - 2) / columnsPerPixel), 1, kVisibilityChunk);
    for (int x = 0; x < output.width; ++x) {
        const int base = columns_.first[static_cast<std::size_t>(x)];
        column_.push_back(std::clamp(base, 0, video.width - 1) - 1 + kSampleMargin);
        sampleColumn_.push_back(base - 1 + kSampleMargin);
        for (const float weight : distanceWeights(columns_.share[static_cast<std::size_t>(x)]))
            columnWeights_.push_back(weight);
        const int left = layerColumns_.first[static_cast<std::size_t>(x)];
        layerLeft_.push_back(std::clamp(left, 0, layer.width - 1));
        layerRight_.push_back(std::clamp(left + 1, 0, layer.width - 1));
        layerShare_.push_back(twiceInAWord(layerColumns_.share[static_cast<std::size_t>(x)]));
    }
    // Padding for vectors that read beyond the last pixel.
    layerLeft_.resize(layerLeft_.size() + kLayerSpare, layer.width - 1);
    layerRight_.resize(layerRight_.size() + kLayerSpare, layer.width - 1);
    layerShare_.resize(layerShare_.size() + kLayerSpare);
}

void OcclusionStep::run(const LayerRowsView& layer, const RealDepth& real, const RgbPlanes& video,
                        Rows<std::uint32_t> picture) {
    assert(real.inverse.size == video_ && real.sigma.size == video_ && video.size() == video_);
    assert(picture.size == output_);
    assert(layer.colour.size == layer_ && layer.depth.size == layer_);
    const PixelRect bounds = layerInOutput(layer.bounds, layer_, output_);
    if (bounds.empty()) return;
    // Returns the video pixels that the output pixels in `bounds` read along one axis: two before
    // and two after each of them. The range is limited to the video.
    const auto samples = [](int firstBase, int lastBase, int count) {
        return std::pair(std::max(std::min(firstBase, count - 1) - 1, 0),
                         std::min(std::max(lastBase, 0) + 2, count - 1) + 1);
    };
    const auto baseOf = [](const Between& between, int pixel) {
        return between.first[static_cast<std::size_t>(pixel)];
    };
    const auto [first, last] =
        samples(baseOf(columns_, bounds.x0), baseOf(columns_, bounds.x1 - 1), video_.width);
    const int upper = baseOf(rows_, bounds.y0), lower = baseOf(rows_, bounds.y1 - 1);
    const auto [top, bottom] = samples(upper, lower, video_.height);
    const Task task{layer, real, video, picture, bounds, first, last};
    forRows(workers_.get(), top, bottom, 16, [&](int y) { prepareRow(task, y); });
    forRows(workers_.get(), upper, lower + 1, 4, [&](int base) { drawRows(task, base); });
}

SampleRow OcclusionStep::samplesOf(int y) {
    return {inverse_[y], variance_[y], red_[y], green_[y], blue_[y], nearest_[y], farthest_[y]};
}

SampleWindow OcclusionStep::windowOf(int y) {
    const int base = rows_.first[static_cast<std::size_t>(y)];
    SampleWindow out{{}, distanceWeights(rows_.share[static_cast<std::size_t>(y)])};
    for (int j = 0; j < 4; ++j)
        out.rows[static_cast<std::size_t>(j)] =
            samplesOf(std::clamp(base - 1 + j, 0, video_.height - 1));
    return out;
}

void OcclusionStep::prepareRow(const Task& task, int y) {
    const SampleRow row = samplesOf(y);
    const SampleRow pixels{row.inverse + kSampleMargin, row.variance + kSampleMargin,
                           row.red + kSampleMargin,     row.green + kSampleMargin,
                           row.blue + kSampleMargin,    row.nearest + kSampleMargin,
                           row.farthest + kSampleMargin};
    prepareSamples({task.real.inverse[y], task.real.sigma[y], task.real.squared,
                    task.video.row(0, y), task.video.row(1, y), task.video.row(2, y)},
                   params_.bounds, task.first, task.last, pixels);
    for (float* values :
         {row.inverse, row.variance, row.red, row.green, row.blue, row.nearest, row.farthest})
        repeatBorder(values, video_.width);
    spreadSamples(row.nearest + task.first, row.farthest + task.first, task.last - task.first + 1);
}

void OcclusionStep::drawRows(const Task& task, int base) {
    const auto found = std::ranges::equal_range(rows_.first, base);
    const auto rowAt = [&](auto place) { return static_cast<int>(place - rows_.first.begin()); };
    const int top = std::max(rowAt(found.begin()), task.bounds.y0);
    const int bottom = std::min(rowAt(found.end()), task.bounds.y1);
    if (top >= bottom) return;  // no output row: the output has fewer rows than the video
    FourRows nearest{}, farthest{};
    const int middle = std::clamp(base, 0, video_.height - 1);
    for (int j = 0; j < 4; ++j) {
        const int y = std::clamp(middle - 1 + j, 0, video_.height - 1);
        nearest.row[j] = nearest_[y] + task.first;
        farthest.row[j] = farthest_[y] + task.first;
    }
    float *greatest = greatest_[base + 1], *least = least_[base + 1];
    rangeOfSamples(nearest, farthest, task.last - task.first + 1, greatest + task.first,
                   least + task.first);
    Strip strip;
    for (int x = task.bounds.x0; x < task.bounds.x1; x += longestStrip_) {
        strip.x = x;
        strip.count = std::min(longestStrip_, task.bounds.x1 - x);
        for (int i = 0; i < strip.count; ++i) {
            const int column = column_[static_cast<std::size_t>(x + i)];
            strip.greatest[static_cast<std::size_t>(i)] = greatest[column];
            strip.least[static_cast<std::size_t>(i)] = least[column];
        }
        for (int y = top; y < bottom; ++y)
            drawPart(task, strip, y);
    }
}

void OcclusionStep::drawPart(const Task& task, Strip& strip, int y) {
    const auto first = static_cast<std::size_t>(strip.x);
    const bool isScaled = layer_ != output_;
    if (isScaled)
        enlargeDepth(task, strip, y);
    else
        std::copy_n(task.layer.depth[y] + strip.x, strip.count, strip.z.data());
    std::uint8_t* visible = strip.visibility.data();
    std::uint32_t* picture = task.picture[y] + strip.x;
    const bool isOpen = decideRow({strip.count, strip.z.data(), strip.greatest.data(),
                                   strip.least.data(), visible, strip.inverse.data()},
                                  params_);
    if (isOpen)
        weighOpenPixels({strip.count, &sampleColumn_[first], &columnWeights_[4 * first], picture,
                         strip.inverse.data(), visible},
                        windowOf(y), params_);
    std::copy_n(visible, strip.count, visibility_[y] + strip.x);
    const auto isSeen = [](std::uint8_t share) { return share != 0; };
    if (isScaled && std::any_of(visible, visible + strip.count, isSeen))
        enlargeColour(task, strip, y);
    blendRow(isScaled ? strip.colours.data() : task.layer.colour[y] + strip.x, visible, strip.count,
             picture);
}

LayerColumns OcclusionStep::layerColumns(const Strip& strip) const {
    const auto first = static_cast<std::size_t>(strip.x);
    return {&layerLeft_[first], &layerRight_[first], &layerShare_[first], layerLeft_[first],
            layerRight_[first + static_cast<std::size_t>(strip.count) - 1]};
}

OcclusionStep::TwoRows OcclusionStep::layerRowsAt(int y) const {
    const int base = layerRows_.first[static_cast<std::size_t>(y)];
    return {std::clamp(base, 0, layer_.height - 1), std::clamp(base + 1, 0, layer_.height - 1),
            layerRows_.share[static_cast<std::size_t>(y)]};
}

void OcclusionStep::enlargeDepth(const Task& task, Strip& strip, int y) const {
    const LayerColumns columns = layerColumns(strip);
    const auto [above, below, share] = layerRowsAt(y);
    const int count = columns.last - columns.origin + 1;
    std::copy_n(task.layer.depth[above] + columns.origin, count, strip.depthAbove.data());
    std::copy_n(task.layer.depth[below] + columns.origin, count, strip.depthBelow.data());
    enlargeDepths(strip.depthAbove.data(), strip.depthBelow.data(), share, columns, strip.count,
                  strip.z.data());
}

void OcclusionStep::enlargeColour(const Task& task, Strip& strip, int y) const {
    const LayerColumns columns = layerColumns(strip);
    const auto [above, below, share] = layerRowsAt(y);
    const int count = columns.last - columns.origin + 1;
    std::copy_n(task.layer.colour[above] + columns.origin, count, strip.above.data());
    std::copy_n(task.layer.colour[below] + columns.origin, count, strip.below.data());
    const BlendedColours blended{strip.redBlue.data(), strip.greenAlpha.data()};
    blendLayerRows(strip.above.data(), strip.below.data(), share, count, blended);
    enlargeColours(blended, columns, strip.count, strip.colours.data());
}

}  // namespace mfar::simd
