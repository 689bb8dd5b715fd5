#include "pipeline/depth/edge_snap.h"

#include "base/image_layout.h"
#include "pipeline/simd/field_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace mfar {
namespace {

// Width of the band on each side of a depth edge in which depths are replaced [px]. In this band, a
// pixel gets the depth of surrounding pixels of similar colour.
constexpr int kBand = 4;
// Pixels that are at most this far away along each axis vote on a pixel's depth [px].
constexpr int kVoteRadius = 10;
constexpr int kVoters = simd::kVoterStep;
// A pixel is near a depth edge if the inverse depths of the pixels within kBand px along each axis
// differ by more than kJump * (largest of them) + kSigmas * (the pixel's standard deviation).
constexpr float kJump = 0.08F, kSigmas = 3;
constexpr float kLikeness = 12;  // colour distance that halves the weight of a vote [grey levels]
// The voters (pixels that vote on a pixel's depth) are divided into a near and a far group. The
// pixel gets the depth of the group with the larger total weight, but only if this weight is at
// least kLeastWeight. The weight of a vote is at most 1.
constexpr float kLeastWeight = 0.75F;

static_assert(kBand <= simd::kMostRange);

constexpr int nextVoter(int from) {
    return (from + kVoters - 1) / kVoters * kVoters;
}

using Colour = std::array<int, 3>;

/// Reads colours from a picture of any format. Converts only the requested pixels, because they are
/// few.
class Colours {
public:
    explicit Colours(const ImageView& picture) : picture_(picture) {
        const YuvToRgb rows = yuvToRgb(picture.matrix, picture.range);
        for (std::size_t i = 0; i < rows.size(); ++i)
            for (std::size_t j = 0; j < rows[i].size(); ++j)
                rows_[i][j] = static_cast<int>(std::lround(rows[i][j] * kOne));
    }

    [[nodiscard]] Colour at(int x, int y) const {
        const std::uint8_t* p = picture_.data + static_cast<std::size_t>(y) * picture_.stride +
                                static_cast<std::size_t>(x) * bytesPerPixel(picture_.format);
        switch (picture_.format) {
        case PixelFormat::Gray8: return {p[0], p[0], p[0]};
        case PixelFormat::Rgba8:
        // colour distances do not depend on the order of the channels
        case PixelFormat::Bgra8: return {p[0], p[1], p[2]};
        case PixelFormat::Yuyv: {
            const std::uint8_t* pair = p - 2 * (x % 2);
            return rgbOf(p[0], pair[1], pair[3]);
        }
        case PixelFormat::Nv12: {
            const std::uint8_t* pair = chromaRow(0, y) + x / 2 * 2;
            return rgbOf(p[0], pair[0], pair[1]);
        }
        case PixelFormat::Yuv420: break;
        }
        return rgbOf(p[0], chromaRow(0, y)[x / 2], chromaRow(1, y)[x / 2]);
    }

private:
    static constexpr int kOne = 1 << 12;

    [[nodiscard]] const std::uint8_t* chromaRow(std::size_t plane, int y) const {
        return picture_.chroma[plane].data +
               static_cast<std::size_t>(y) / 2 * picture_.chroma[plane].stride;
    }
    [[nodiscard]] Colour rgbOf(int y, int u, int v) const {
        Colour out{};
        for (std::size_t i = 0; i < out.size(); ++i) {
            const auto& row = rows_[i];
            out[i] = std::clamp((row[0] * y + row[1] * u + row[2] * v + row[3]) / kOne, 0, 255);
        }
        return out;
    }

    ImageView picture_;
    std::array<std::array<int, 4>, 3> rows_{};
};

}  // namespace

EdgeSnap::EdgeSnap(Size video, std::shared_ptr<Workers> workers)
    : size_(video), workers_(std::move(workers)), out_(video) {
    const auto pixels = static_cast<std::size_t>(video.width) * video.height;
    open_.resize(pixels);
    low_.resize(pixels);
    high_.resize(pixels);
    const Size voters{nextVoter(video.width) / kVoters, nextVoter(video.height) / kVoters};
    for (auto* plane :
         {&voters_.inverseDepth, &voters_.variance, &voters_.red, &voters_.green, &voters_.blue})
        *plane = AlignedRows<float>(voters);
}

const InverseDepthField& EdgeSnap::run(const InverseDepthField& in, const ImageView& frame,
                                       const PixelRect& where) {
    const PixelRect before = std::exchange(where_, where);
    findEdges(in, where);
    gatherVoters(in, frame, where);
    workers_->forRange(size_.height, 8, [&](int first, int last) {
        for (int y = first; y < last; ++y) {
            if (y >= before.y0 && y < before.y1) out_.forgetRow(y, before.x0, before.x1);
            if (y < where.y0 || y >= where.y1) continue;
            takeRow(in, where, y);
            snapRow(frame, where, y);
        }
    });
    return out_;
}

// Finds the pixels whose depth the votes decide (open_): pixels near a depth edge, and pixels of
// unknown depth. Near a depth edge, the inverse depths around a pixel have a large range. This
// range is computed first along rows, then along columns.
void EdgeSnap::findEdges(const InverseDepthField& in, const PixelRect& where) {
    if (where.empty()) return;
    const std::ptrdiff_t pitch = size_.width;
    const auto width = static_cast<std::size_t>(where.x1 - where.x0);
    const auto at = [&](int y) { return y * pitch + where.x0; };
    workers_->forRange(where.y1 - where.y0, 8, [&](int first, int last) {
        for (int y = where.y0 + first; y < where.y0 + last; ++y)
            simd::rangeAlongRow(in.inverseDepth.data() + at(y), in.variance.data() + at(y), width,
                                kBand, low_.data() + at(y), high_.data() + at(y));
    });
    workers_->forRange(where.y1 - where.y0, 8, [&](int first, int last) {
        for (int y = where.y0 + first; y < where.y0 + last; ++y) {
            const int begin = std::max(y - kBand, where.y0);
            const int end = std::min(y + kBand + 1, where.y1);
            simd::openRow(low_.data() + at(begin), high_.data() + at(begin), pitch, end - begin,
                          in.inverseDepth.data() + at(y), in.variance.data() + at(y), width,
                          {kJump, kSigmas}, open_.data() + at(y));
        }
    });
}

void EdgeSnap::gatherVoters(const InverseDepthField& in, const ImageView& frame,
                            const PixelRect& where) {
    const Colours colours(frame);
    const int first = nextVoter(where.y0) / kVoters, last = nextVoter(where.y1) / kVoters;
    workers_->forRange(last - first, 4, [&](int begin, int end) {
        for (int j = first + begin; j < first + end; ++j) {
            const int y = kVoters * j;
            const auto row = static_cast<std::size_t>(y) * size_.width;
            for (int x = nextVoter(where.x0); x < where.x1; x += kVoters) {
                const int i = x / kVoters;
                voters_.inverseDepth[j][i] = -1;
                if (open_[row + x] != 0) continue;
                voters_.inverseDepth[j][i] = in.inverseDepth[row + x];
                voters_.variance[j][i] = in.variance[row + x];
                const Colour colour = colours.at(x, y);
                voters_.red[j][i] = static_cast<float>(colour[0]);
                voters_.green[j][i] = static_cast<float>(colour[1]);
                voters_.blue[j][i] = static_cast<float>(colour[2]);
            }
        }
    });
}

void EdgeSnap::takeRow(const InverseDepthField& in, const PixelRect& where, int y) {
    const auto row = static_cast<std::size_t>(y) * size_.width;
    for (std::size_t i = row + where.x0; i < row + where.x1; ++i) {
        const bool sound = InverseDepthField::isSound(in.inverseDepth[i], in.variance[i]);
        out_.inverseDepth[i] = sound ? in.inverseDepth[i] : 0;
        out_.variance[i] = sound ? in.variance[i] : InverseDepthField::kUnknown;
        out_.filled[i] = sound ? in.filled[i] : std::uint8_t{0};
    }
}

void EdgeSnap::snapRow(const ImageView& frame, const PixelRect& where, int y) {
    const Colours colours(frame);
    const std::uint8_t* open = open_.data() + static_cast<std::ptrdiff_t>(y) * size_.width;
    std::array<simd::OpenPixel, 64> pixels;
    std::size_t count = 0;
    for (int x = where.x0; x < where.x1; ++x) {
        if (open[x] == 0) continue;
        const Colour own = colours.at(x, y);
        pixels[count++] = {x, static_cast<float>(own[0]), static_cast<float>(own[1]),
                           static_cast<float>(own[2])};
        if (count == pixels.size())
            decide(where, y, std::span(pixels).first(std::exchange(count, 0)));
    }
    decide(where, y, std::span(pixels).first(count));
}

void EdgeSnap::decide(const PixelRect& where, int y, std::span<simd::OpenPixel> pixels) {
    const simd::Voters voters{voters_.inverseDepth.rows(), voters_.variance.rows(),
                              voters_.red.rows(), voters_.green.rows(), voters_.blue.rows()};
    simd::votePixels(voters, {kVoteRadius, kLikeness, kLeastWeight}, where, y, pixels);
    for (const simd::OpenPixel& pixel : pixels) {
        if (!pixel.decided) continue;
        const auto i = static_cast<std::size_t>(y) * size_.width + pixel.x;
        out_.inverseDepth[i] = pixel.inverseDepth;
        out_.variance[i] = pixel.variance;
        out_.filled[i] = 1;
    }
}

}  // namespace mfar
