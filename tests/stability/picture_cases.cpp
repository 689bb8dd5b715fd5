#include "base/image_layout.h"
#include "pipeline/engine/params/weigh.h"
#include "pipeline/gles/picture_texture.h"
#include "pipeline/pipeline.h"
#include "pipeline/plan/work_plan.h"
#include "tests/engine/gles/levels.h"
#include "tests/engine/gles/tile_pass.h"
#include "tests/oracle/enlarge.h"
#include "tests/oracle/plan.h"
#include "tests/oracle/superres.h"
#include "tests/oracle/yuv.h"
#include "tests/stability/cases.h"
#include "tests/unit/padded_picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mfar::stress {
namespace {

// Largest error of a colour that is converted from a video format. Bilinear look-ups have weights
// of 8 bits, and errors of both chroma channels add up.
constexpr double kFormatError = 2.7;  // [grey levels]

void pictureFormats(Context& c) {
    const auto format = c.hostile.pick({PixelFormat::Gray8, PixelFormat::Rgba8, PixelFormat::Bgra8,
                                        PixelFormat::Yuyv, PixelFormat::Nv12, PixelFormat::Yuv420});
    const Size half = c.size(1, 60);
    const Size size{2 * half.width, 2 * half.height};
    const test::PaddedPicture source(format, size,
                                     static_cast<unsigned>(c.hostile.integer(1, 1 << 30)),
                                     c.hostile.integer(0, 9));
    const ImageView view = source.view(c.hostile.pick({YuvMatrix::Bt601, YuvMatrix::Bt709}),
                                       c.hostile.pick({YuvRange::Limited, YuvRange::Full}));
    gpu::PictureTexture picture;
    picture.upload(view);
    const auto pixels = sampled(picture.texture());
    c.gl.frame(c.checks, pixelsOf(size));
    RgbPlanes planes(size);
    planes.take(view);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const auto rgb = twin::rgbAt(view, x, y);
            const std::size_t i = 4 * (static_cast<std::size_t>(y) * size.width + x);
            for (std::size_t k = 0; k < 3; ++k)
                c.checks.within(pixels[i + k] - rgb[k], -kFormatError, kFormatError,
                                "error of a colour on the GPU");
            for (int k = 0; k < 3; ++k)
                c.checks.within(planes.row(k, y)[x] - rgb[k], -kFormatError, kFormatError,
                                "error of a colour on the host");
        }
}

// Luma is rounded twice. So it may differ from the oracle's luma by one grey level.
void lumaPyramids(Context& c) {
    const Size size = c.size(1, 120);
    const TestPicture a = c.hostile.picture(size), b = c.hostile.picture(size);
    const LevelPair pair(a, b);
    const auto compare = [&](const twin::Grey& got, const twin::Grey& wanted, const char* what) {
        for (std::size_t i = 0; i < got.values.size(); ++i)
            c.checks.within(got.values[i] - wanted.values[i], -1.01, 1.01, what);
    };
    compare(pair.first(), twin::smoothed(twin::luma(a.view())),
            "error of luma at the finest pyramid level");
    for (int level = 1; level < static_cast<int>(pair.pyramids.video().size()); ++level) {
        compare(pair.first(level), twin::halved(pair.first(level - 1)),
                "error of luma at a coarser pyramid level");
        compare(pair.second(level), twin::halved(pair.second(level - 1)),
                "error of luma at a coarser pyramid level");
    }
    c.gl.frame(c.checks, pixelsOf(size));
}

TestPicture changed(Context& c, const TestPicture& before) {
    const Size size = before.size;
    if (c.hostile.chance(0.3)) return c.hostile.picture(size);
    TestPicture out = before;
    const int x0 = c.hostile.integer(0, size.width - 1), y0 = c.hostile.integer(0, size.height - 1);
    if (c.hostile.chance(0.5)) out.at(x0, y0)[1] ^= 64;
    if (c.hostile.chance(0.5)) return out;
    const int side = c.hostile.integer(1, 12), step = c.hostile.pick({2, 8, 40});
    for (int y = y0; y < std::min(y0 + side, size.height); ++y)
        for (int x = x0; x < std::min(x0 + side, size.width); ++x)
            for (int k = 0; k < 3; ++k)
                out.at(x, y)[k] = static_cast<std::uint8_t>(std::min(out.at(x, y)[k] + step, 255));
    return out;
}

void changePlan(Context& c) {
    const Size size = c.size(1, 120);
    const TestPicture before = c.hostile.picture(size), now = changed(c, before);
    WorkPlan plan(size);
    plan.update(planesOf(now), planesOf(before), false);
    const Size tiles = plan.tileCount();
    const auto count = static_cast<std::size_t>(pixelsOf(tiles));
    const std::vector<TileWork::Tile>& got = plan.work().flags;
    std::vector<twin::TileChange> twins;
    const twin::Grey grey = twin::luma(now.view());
    int changed = 0;
    for (int t = 0; t < static_cast<int>(count); ++t) {
        const auto& twin = twins.emplace_back(
            twin::tileChange(now, before, grey, t % tiles.width, t / tiles.width));
        changed += static_cast<int>(got[static_cast<std::size_t>(t)].changed);
        const TileMeasure& measured = plan.measured()[t];
        c.checks.within(measured.noise - twin.noise, -0.02, 0.02, "error of a tile's noise");
        c.checks.within(measured.structure / (1 + twin.structure) -
                            twin.structure / (1 + twin.structure),
                        -1e-2, 1e-2, "error of a tile's structure");
        const std::array energy{measured.pixels, measured.means, measured.bends};
        for (std::size_t k = 0; k < 3; ++k)
            c.checks.within(energy[k] / (1 + twin.energy[k]) -
                                twin.energy[k] / (1 + twin.energy[k]),
                            -1e-3, 1e-3, "error of the variance of a tile's difference");
    }
    // WorkPlan::update() uses these thresholds before it has measured any noise.
    const auto wanted = twin::changedTiles(twins, tiles.width, {1 + 2 * 0.29, 1.5 + 4 * 0.29});
    for (std::size_t t = 0; t < count; ++t)
        c.checks.require(!wanted[t] ||
                             (got[static_cast<std::size_t>(t)].changed != 0) == *wanted[t],
                         "a tile is marked as changed or unchanged by mistake");
    c.checks.require(plan.work().changed == changed,
                     "the number of changed tiles differs from their marks");
    c.checks.through("TileMeasure", pixelsOf(size));
    c.gl.frame(c.checks, pixelsOf(size));
}

// Without a still, the output must be the enlarged video. The video is first enlarged vertically,
// this result is rounded to 8 bits, and then it is enlarged horizontally.
void enlargement(Context& c) {
    const Size video = c.size(1, 60);
    const Size output{video.width * c.hostile.integer(1, 4) + c.hostile.integer(0, 3),
                      video.height * c.hostile.integer(1, 4) + c.hostile.integer(0, 3)};
    const TestPicture picture = c.hostile.picture(video);
    PipelineOptions options;
    options.mode = SuperResMode::Off;
    options.output = output;
    Pipeline pipeline(plainRig(video, {2 * video.width, 2 * video.height}), options);
    const bool linear = c.hostile.chance(0.3);
    pipeline.setQuality({.mode = SuperResMode::Off, .cubic = !linear});
    pipeline.run(picture.view(), {});
    const auto image = pipeline.readImage();
    c.gl.frame(c.checks, pixelsOf(video));
    for (int channel = 0; channel < 3; ++channel) {
        const twin::Grey grey = twin::greyOf(video, [&](int x, int y) {
            return double(picture.bytes[4UL * (1UL * y * video.width + x) + channel]);
        });
        twin::Grey columns = twin::enlargedColumns(grey, output.height, linear);
        for (double& value : columns.values)
            value = std::floor(std::clamp(value, 0.0, 255.0) + 0.5);
        const twin::Grey wanted = twin::enlargedRows(columns, output.width, linear);
        for (std::size_t i = 0; i < wanted.values.size(); ++i)
            c.checks.within(image[4 * i + channel] - std::clamp(wanted.values[i], 0.0, 255.0), -2,
                            2, "error of an enlarged pixel");
    }
}

// A constant picture must stay constant, whatever the still is.
void evenPicture(Context& c) {
    const Size video = c.hostile.size(1, 60), still = c.hostile.size(8, 150);
    const auto level = static_cast<std::uint8_t>(c.hostile.integer(0, 255));
    PipelineOptions options;
    options.mode = SuperResMode::Detail;
    Pipeline pipeline(plainRig(video, still), options);
    pipeline.setQuality({.learned = c.hostile.chance(0.5)});
    pipeline.setStill(c.hostile.picture(still).view(), {});
    for (int i = 0; i < 2; ++i)
        pipeline.run(TestPicture(video, PixelFormat::Rgba8, level).view(), {});
    c.gl.frame(c.checks, pixelsOf(video));
    const std::vector<std::uint8_t> shown = pipeline.readImage();
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const bool isAlpha = i % 4 == 3;
        const int wanted = isAlpha ? 255 : level, change = isAlpha ? 0 : 1;
        c.checks.within(shown[i] - wanted, -change, change, "change of a constant picture");
    }
}

/// Random statistics of cells, see twin::weigh(). The variances are sums over an 8x8 patch, from 0
/// to the largest sum that bytes can have.
twin::Cells statisticsOf(Context& c, Size size) {
    twin::Cells out{size, {}};
    constexpr double kMost = 64 * 255.0 * 255.0 / 4;
    for (long i = 0; i < pixelsOf(size); ++i) {
        const double a = c.hostile.chance(0.2) ? 0 : c.hostile.logarithmic(1e-3, kMost);
        const double b = c.hostile.chance(0.2) ? kMost : c.hostile.logarithmic(1e-3, kMost);
        const double alike = c.hostile.real(-1, 1);
        for (const double v : {alike * std::sqrt(a * b), a, b, c.hostile.real(0, 1)})
            out.values.push_back(static_cast<float>(v));
    }
    return out;
}

twin::Cells displacementOf(Context& c, Size size) {
    twin::Cells out{size, {}};
    const double bend = c.hostile.logarithmic(1e-4, 1e3);
    for (long i = 0; i < 4 * pixelsOf(size); ++i)
        out.values.push_back(static_cast<float>(bend * c.hostile.real(-1, 1)));
    return out;
}

void weights(Context& c) {
    const Size size = c.size(1, 60), half{(size.width + 1) / 2, (size.height + 1) / 2};
    const twin::Cells displacement = displacementOf(c, size);
    const twin::Cells statistics = statisticsOf(c, size), low = statisticsOf(c, half);
    const double sigma = c.hostile.real(0.05, 4);
    using gpu::TexelFormat;
    const auto put = [](const twin::Cells& cells) {
        return floatTexture(cells.size, TexelFormat::Rgba32F, cells.values);
    };
    const gpu::Texture d = put(displacement), s = put(statistics), l = put(low);
    const gpu::Texture field(size, TexelFormat::Rgba32F), weight(size, TexelFormat::Rgba8);
    const gpu::Texture look(size, TexelFormat::Rgba16F);
    gpu::ComputePass<params::WeighCells> pass("superres_weigh.comp");
    pass.run({.columns = size.width,
              .rows = size.height,
              .halfColumns = half.width,
              .halfRows = half.height,
              .noise = static_cast<float>(sigma)},
             {gpu::sampler(0, d), gpu::sampler(1, s), gpu::sampler(2, l), gpu::imageWrite(0, field),
              gpu::imageWrite(1, weight), gpu::imageWrite(2, look)},
             {gpu::groupsFor(size.width, 8), gpu::groupsFor(size.height, 8), 1});
    const twin::Cells got{size, field.readRgba32F()};
    const auto bytes = weight.readRgba8();
    c.gl.frame(c.checks, 16 * pixelsOf(size));
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const auto wanted = twin::weigh(displacement, statistics, low, x, y, sigma);
            const double slack = std::max(0.005, 2e-3 * wanted.weight);
            c.checks.within(got.at(x, y)[2] - wanted.weight, -slack, slack, "error of a weight");
            c.checks.within(got.at(x, y)[3] - wanted.confidence, -1e-6, 1e-6,
                            "error of a confidence");
            const std::size_t i = 4 * (static_cast<std::size_t>(y) * size.width + x);
            c.checks.within(bytes[i + 2] / 255.0 - wanted.signal, -0.01, 0.01,
                            "error of the share of signal in the variance");
        }
}

}  // namespace

std::vector<Case> pictureCases() {
    return {{"formats", pictureFormats, true}, {"pyramids", lumaPyramids, true},
            {"plan", changePlan, true},        {"enlargement", enlargement},
            {"even-picture", evenPicture},     {"weights", weights}};
}

}  // namespace mfar::stress
