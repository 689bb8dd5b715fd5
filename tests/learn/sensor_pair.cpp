#include "tests/learn/sensor_pair.h"

#include "pipeline/enlarge/filter_layout.h"
#include "pipeline/flow/cell_field.h"
#include "tests/oracle/learned.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace mfar {
namespace {

using enlarge::kGrid;
using twin::Grey;

Grey blurred(const Grey& g) {
    const auto mix = [](double a, double b, double c) { return (a + 2 * b + c) / 4; };
    const Grey rows = twin::greyOf(
        g.size, [&](int x, int y) { return mix(g.at(x - 1, y), g.at(x, y), g.at(x + 1, y)); });
    return twin::greyOf(g.size, [&](int x, int y) {
        return mix(rows.at(x, y - 1), rows.at(x, y), rows.at(x, y + 1));
    });
}

void finish(Grey& g, int blur, double noise, unsigned seed) {
    for (int i = 0; i < blur; ++i)
        g = blurred(g);
    std::mt19937 random(seed);
    for (double& value : g.values) {
        const double a = (random() + 1.0) / 4294967297.0, b = random() / 4294967296.0;
        const double normal = std::sqrt(-2 * std::log(a)) * std::cos(2 * std::numbers::pi * b);
        value = std::clamp(std::round(value + noise * normal), 0.0, 255.0);
    }
}

std::vector<std::uint8_t> bytesOf(const Grey& g) {
    return {g.values.begin(), g.values.end()};
}

using Hear = decltype(&MatchListener::matched);
void tell(MatchListener& listener, Hear hear, const Grey& sharp, const Grey& still,
          const SensorPair& pair) {
    const Grey video = videoOf(sharp, pair);
    Grey seen = twin::greyOf(still.size, [&](int x, int y) {
        return 255 * pair.gain * std::pow(still.at(x, y) / 255, pair.gamma);
    });
    finish(seen, pair.stillBlur, pair.stillNoise, pair.seed + 1000);
    const std::vector<std::uint8_t> videoBytes = bytesOf(video), stillBytes = bytesOf(seen);
    RgbPlanes planes(video.size);
    planes.take({videoBytes.data(), video.size, std::size_t(video.size.width), PixelFormat::Gray8});
    AlignedRows<LookUpCell> lookUps(cellsOf(video.size));
    for (int y = 0; y < lookUps.size().height; ++y)
        std::fill_n(
            lookUps[y], lookUps.size().width,
            LookUpCell{float(kGrid * pair.shift), 0, float(pair.weight), float(pair.confidence)});
    (listener.*hear)(planes, {stillBytes.data(), seen.size.width, seen.size}, lookUps.rows(),
                     {seen.size, kGrid, kGrid});
}

}  // namespace

Grey sharpDiscs(unsigned seed, Size video) {
    std::mt19937 random(seed);
    const Size size{kGrid * video.width, kGrid * video.height};
    Grey out = twin::greyOf(size, [](int, int) { return 120.0; });
    for (int i = 0; i < size.width * size.height / 900; ++i) {
        const int cx = int(random() % size.width), cy = int(random() % size.height),
                  r = 5 + int(random() % 40);
        const double level = 30 + double(random() % 196);
        for (int y = std::max(cy - r, 0); y < std::min(cy + r, size.height); ++y)
            for (int x = std::max(cx - r, 0); x < std::min(cx + r, size.width); ++x)
                if ((x - cx) * (x - cx) + (y - cy) * (y - cy) < r * r)
                    out.values[std::size_t(y) * size.width + x] = level;
    }
    return blurred(out);
}

StereoRig discsRig() {
    StereoRig rig;
    rig.video = {kDiscsVideo, 240, 240, 127.5, 95.5, {}};
    rig.still = {kDiscsStill, 960, 960, 511.5, 383.5, {}};
    return rig;
}

std::vector<std::uint8_t> bytesOf(const Grey& picture) {
    return {picture.values.begin(), picture.values.end()};
}

Grey videoOf(const Grey& sharp, const SensorPair& pair) {
    Grey out =
        twin::greyOf({sharp.size.width / kGrid, sharp.size.height / kGrid}, [&](int x, int y) {
            double sum = 0;
            for (int k = 0; k < kGrid * kGrid; ++k) {
                const double value = sharp.at(kGrid * x + k % kGrid, kGrid * y + k / kGrid);
                sum += pair.averagesLight ? value * value : value;
            }
            const double mean = sum / (kGrid * kGrid);
            return pair.averagesLight ? std::sqrt(mean) : mean;
        });
    finish(out, pair.videoBlur, pair.videoNoise, pair.seed);
    return out;
}

void showTo(MatchListener& listener, const Grey& sharp, const Grey& still, const SensorPair& pair) {
    tell(listener, &MatchListener::matched, sharp, still, pair);
}

void showReplacedTo(MatchListener& listener, const Grey& sharp, const Grey& still,
                    const SensorPair& pair) {
    tell(listener, &MatchListener::replaced, sharp, still, pair);
}

MatchedPictures matchedPictures(const Grey& sharp, const Grey& still, const SensorPair& pair) {
    struct Copier final : MatchListener {
        MatchedPictures pictures;
        void matched(const RgbPlanes& video, Rows<const std::uint8_t> luma,
                     Rows<const LookUpCell> lookUps,
                     const MatchedPictures::LookedUp& lookedUp) override {
            pictures.take(video, luma, lookUps, lookedUp);
        }
    } copier;
    showTo(copier, sharp, still, pair);
    return std::move(copier.pictures);
}

double enlargingError(const Grey& sharp, const SensorPair& pair, const FilterBank* bank) {
    const Grey video = videoOf(sharp, pair);
    const Grey cubic = twin::enlarged(video, sharp.size);
    const Grey residual = bank != nullptr ? twin::residualGrid(video, *bank)
                                          : twin::greyOf(sharp.size, [](int, int) { return 0.0; });
    double sum = 0;
    int count = 0;
    constexpr int kBorder = 32;
    for (int y = kBorder; y < sharp.size.height - kBorder; ++y)
        for (int x = kBorder; x < sharp.size.width - kBorder; ++x, ++count)
            sum += std::pow(cubic.at(x, y) + residual.at(x, y) - sharp.at(x, y), 2);
    return sum / count;
}

}  // namespace mfar
