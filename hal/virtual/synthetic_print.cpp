#include "hal/virtual/synthetic_hash.h"
#include "hal/virtual/synthetic_textures.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

namespace mfar::synthetic {
namespace {

// A printed sheet is drawn as a picture of ink with the aspect ratio of A4 and more than twice the
// resolution of a texture layer. It is then reduced to the square layer.
constexpr int kInkWidth = 2100, kInkHeight = 2970;  // ten ink pixels per millimetre
constexpr unsigned char kNoInk = 0;

std::string word(Random& random) {
    constexpr std::array<std::string_view, 24> kSyllables{
        "ta", "re",  "mi", "lo", "con", "ver", "st",  "an", "ele", "qui", "sor", "pa",
        "ge", "tri", "fo", "un", "der", "by",  "lim", "ac", "nu",  "hi",  "dra", "es"};
    std::string out;
    for (int i = 1 + random.below(3); i >= 0; --i)
        out += kSyllables[random.below(24)];
    return out;
}

struct Column {
    int left, right, top, bottom;
    double scale;
    int pitch;
};

void setText(cv::Mat1b& ink, Random& random, const Column& column) {
    constexpr int kFont = cv::FONT_HERSHEY_COMPLEX;
    const int thickness = column.scale > 1 ? 3 : 2;
    int left = column.left;
    int linesLeft = 4 + random.below(8);
    for (int y = column.top + column.pitch; y < column.bottom; y += column.pitch) {
        const int right =
            linesLeft == 0 ? column.left + (column.right - column.left) * 2 / 3 : column.right;
        for (int x = left; x < right;) {
            std::string text = word(random);
            if (x == column.left || random.below(9) == 0)
                text[0] = static_cast<char>(std::toupper(text[0]));
            if (random.below(8) == 0) text += random.below(2) == 0 ? "," : ".";
            const int width = cv::getTextSize(text, kFont, column.scale, thickness, nullptr).width;
            if (x + width > right) break;
            cv::putText(ink, text, {x, y}, kFont, column.scale, 255, thickness, cv::LINE_AA);
            x += width + static_cast<int>(16 * column.scale);
        }
        left = column.left;
        if (--linesLeft < 0) {
            y += column.pitch / 2;
            left += 60;
            linesLeft = 4 + random.below(8);
        }
    }
}

void setHeading(cv::Mat1b& ink, Random& random, int x, int y, double scale) {
    const std::string text = word(random) + " " + word(random);
    cv::putText(ink, text, {x, y}, cv::FONT_HERSHEY_TRIPLEX, scale, 255,
                static_cast<int>(2.5 * scale), cv::LINE_AA);
}

void drawDiagram(cv::Mat1b& ink, Random& random, cv::Rect box) {
    cv::rectangle(ink, box, 255, 4, cv::LINE_AA);
    for (int i = 1; i < 8; ++i) {
        const int x = box.x + box.width * i / 8, y = box.y + box.height * i / 8;
        cv::line(ink, {x, box.y}, {x, box.y + box.height}, 90, 1, cv::LINE_AA);
        cv::line(ink, {box.x, y}, {box.x + box.width, y}, 90, 1, cv::LINE_AA);
    }
    for (int curve = 0; curve < 3; ++curve) {
        const double phase = random.range(0, 6), rate = random.range(4, 14);
        cv::Point last;
        for (int i = 0; i <= 200; ++i) {
            const double u = i / 200., v = 0.5 + 0.35 * std::sin(rate * u + phase) * (1 - 0.5 * u);
            const cv::Point p(box.x + static_cast<int>(u * box.width),
                              box.y + static_cast<int>(v * box.height));
            if (i > 0 && (curve != 1 || i % 8 < 5)) cv::line(ink, last, p, 255, 5, cv::LINE_AA);
            last = p;
        }
    }
}

cv::Mat4b pressed(const cv::Mat1b& ink, std::uint64_t seed, cv::Vec3f inkColour) {
    cv::Mat1b small;
    cv::resize(ink, small, {kLayerSize, kLayerSize}, 0, 0, cv::INTER_AREA);
    const cv::Mat1f fibre = fractal(seed, 128, 90, 3, 0.7F);
    cv::Mat3f colour(kLayerSize, kLayerSize);
    eachPixel(colour, [&](cv::Vec3f& c, const int* at) {
        const float cover = static_cast<float>(small(at)) / 255;
        const float sheet = 0.80F + 0.07F * (fibre(at) - 0.5F);
        c = cv::Vec3f{sheet, sheet * 0.985F, sheet * 0.94F} * (1 - cover) + inkColour * cover;
    });
    return toBytes(colour, cv::Mat1f(colour.size(), 0.05F));
}

cv::Mat4b paper(std::uint64_t seed) {
    cv::Mat1b ink(kInkHeight, kInkWidth, kNoInk);
    Random random(seed);
    setHeading(ink, random, 230, 330, 2.6);
    setText(ink, random, {230, 1880, 380, 2700, 1.15, 52});
    cv::putText(ink, "- 17 -", {980, 2830}, cv::FONT_HERSHEY_COMPLEX, 1.1, 255, 2, cv::LINE_AA);
    return pressed(ink, seed, {0.035F, 0.035F, 0.045F});
}

cv::Mat4b article(std::uint64_t seed) {
    cv::Mat1b ink(kInkHeight, kInkWidth, kNoInk);
    Random random(seed);
    setHeading(ink, random, 160, 300, 3.6);
    cv::line(ink, {160, 360}, {1940, 360}, 255, 5);
    setText(ink, random, {160, 1010, 400, 2800, 0.85, 40});
    drawDiagram(ink, random, {1100, 460, 820, 620});
    setText(ink, random, {1090, 1940, 1130, 1900, 0.85, 40});
    drawDiagram(ink, random, {1100, 1980, 820, 330});
    setText(ink, random, {1090, 1940, 2360, 2800, 0.7, 33});
    return pressed(ink, seed, {0.04F, 0.04F, 0.06F});
}

cv::Mat4b bound(const cv::Mat1b& ink, std::uint64_t seed) {
    cv::Mat1b small;
    cv::resize(ink, small, {kLayerSize, kLayerSize}, 0, 0, cv::INTER_AREA);
    const cv::Mat1f fuzz = fractal(seed, 256, 256, 2, 0.8F);
    cv::Mat3f colour(kLayerSize, kLayerSize);
    eachPixel(colour, [&](cv::Vec3f& c, const int* at) {
        const bool over = (at[0] / 3 + at[1] / 3) % 2 == 0;
        const float linen = (over ? 0.62F : 0.45F) * (0.7F + 0.6F * fuzz(at));
        const float gold = static_cast<float>(small(at)) / 255;
        c = cv::Vec3f::all(linen) * (1 - gold) + cv::Vec3f{1.F, 0.98F, 0.9F} * gold;
    });
    cv::Mat1f gloss;
    small.convertTo(gloss, CV_32F, 0.8 / 255, 0.08);
    return toBytes(colour, gloss);
}

cv::Mat4b cover(std::uint64_t seed) {
    cv::Mat1b ink(kInkHeight, kInkWidth, kNoInk);
    Random random(seed);
    cv::rectangle(ink, {120, 120, kInkWidth - 240, kInkHeight - 240}, 255, 12);
    cv::rectangle(ink, {160, 160, kInkWidth - 320, kInkHeight - 320}, 255, 4);
    setHeading(ink, random, 280, 700, 4.2);
    setHeading(ink, random, 280, 860, 4.2);
    for (int i = 0; i < 14; ++i)
        cv::circle(ink, {1050, 1600}, 60 + 36 * i, 255, i % 3 == 0 ? 10 : 4, cv::LINE_AA);
    setHeading(ink, random, 640, 2560, 2.0);
    return bound(ink, seed);
}

cv::Mat4b spine(std::uint64_t seed) {
    cv::Mat1b lying(420, kInkHeight, kNoInk);
    Random random(seed);
    for (const int x : {150, 190, 2760, 2800})
        cv::rectangle(lying, {x, 0, x % 100 == 50 || x == 2800 ? 8 : 20, lying.rows}, 255,
                      cv::FILLED);
    setHeading(lying, random, 330, 250, 3.4);
    setHeading(lying, random, 1900, 240, 2.0);
    cv::Mat1b ink;
    cv::rotate(lying, ink, cv::ROTATE_90_CLOCKWISE);
    return bound(ink, seed);
}

cv::Mat4b label(std::uint64_t seed) {
    cv::Mat1b ink(kInkHeight, kInkWidth, kNoInk);
    Random random(seed);
    cv::rectangle(ink, {0, 240, kInkWidth, 60}, 255, cv::FILLED);
    setHeading(ink, random, 260, 820, 5.5);
    setText(ink, random, {260, 1850, 900, 1700, 1.6, 78});
    for (int x = 320; x < 1240;) {
        const int bar = 6 + 6 * random.below(4);
        cv::rectangle(ink, {x, 1850, bar, 640}, 255, cv::FILLED);
        x += bar + 6 + 6 * random.below(4);
    }
    cv::rectangle(ink, {0, 2660, kInkWidth, 60}, 255, cv::FILLED);
    return pressed(ink, seed, {0.35F, 0.03F, 0.04F});
}

cv::Mat4b edges(std::uint64_t seed) {
    const cv::Mat1f sheets = noise(seed, 6, 400), waves = fractal(seed + 1, 8, 30, 3);
    cv::Mat3f colour(kLayerSize, kLayerSize);
    eachPixel(colour, [&](cv::Vec3f& c, const int* at) {
        const float v = 0.50F + 0.45F * (sheets(at) - 0.5F) + 0.25F * (waves(at) - 0.5F);
        c = cv::Vec3f{v, v * 0.95F, v * 0.83F};
    });
    return toBytes(colour, cv::Mat1f(colour.size(), 0.02F));
}

cv::Mat4b tags(std::uint64_t seed) {
    constexpr int kHalf = kLayerSize / 2;
    const cv::Mat1f grain = fractal(seed, 200, 200, 2, 0.7F);
    cv::Mat3f colour(kLayerSize, kLayerSize);
    std::array<TagCells, 4> cells{};
    for (int i = 0; i < 4; ++i)
        cells[i] = tagCells(kTagIds[i]);
    eachPixel(colour, [&](cv::Vec3f& c, const int* at) {
        const int which = at[0] / kHalf * 2 + at[1] / kHalf;
        const auto cell = [=](int texel) { return (2 * (texel % kHalf) + 1) * 5 / kHalf - 1; };
        const int x = cell(at[1]), y = cell(at[0]);
        const bool rim = x < 0 || y < 0 || x > 7 || y > 7;
        const bool white = rim || cells[which][y][x];
        c = cv::Vec3f::all((white ? 0.82F : 0.03F) + 0.03F * grain(at));
    });
    return toBytes(colour, cv::Mat1f(colour.size(), 0.05F));
}

}  // namespace

cv::Mat4b makePrint(Layer layer, std::uint64_t seed) {
    switch (layer) {
    case Layer::Paper: return paper(seed);
    case Layer::Article: return article(seed);
    case Layer::Cover: return cover(seed);
    case Layer::Spine: return spine(seed);
    case Layer::Label: return label(seed);
    case Layer::Edges: return edges(seed);
    case Layer::AprilGrid: return aprilGrid(seed);
    default: return tags(seed);
    }
}

}  // namespace mfar::synthetic
