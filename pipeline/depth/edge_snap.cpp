#include "pipeline/depth/edge_snap.h"

#include "base/image_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mfar {
namespace {

constexpr int kBand = 4;         // undecided on both sides of a depth edge [px]
constexpr int kVoteRadius = 10;  // from where surfaces are taken [px]
constexpr int kVoters = 2;       // every so manyth column and row votes
// An edge, no slope: so much of the nearer inverse depth within 2 kBand + 1 pixels, and more than
// noise makes.
constexpr float kJump = 0.08F, kSigmas = 3;
constexpr float kLikeness = 12;        // colours so far apart are alike by half [grey levels]
constexpr float kLeastWeight = 0.75F;  // of all voters, each at most one
constexpr float kLargest = std::numeric_limits<float>::max();

constexpr int nextVoter(int from) {
    return (from + kVoters - 1) / kVoters * kVoters;
}

using Colour = std::array<int, 3>;

/// Colours of a picture of any format, each where it is asked for: few pixels are.
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
        case PixelFormat::Bgra8: return {p[0], p[1], p[2]};  // of distances the order is nothing
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

float likeness(const Colour& a, const Colour& b) {
    const int r = a[0] - b[0], g = a[1] - b[1], u = a[2] - b[2];
    const float square = static_cast<float>(r * r + g * g + u * u) / (kLikeness * kLikeness);
    return 1 / (1 + square * square);
}

bool isSound(const InverseDepthField& field, std::size_t pixel) {
    return InverseDepthField::isSound(field.rho[pixel], field.variance[pixel]);
}

/// Those that vote for one of two surfaces.
struct Side {
    float weight = 0, rho = 0, variance = 0;
    void add(float w, float r, float v) {
        weight += w;
        rho += w * r;
        variance += w * v;
    }
};

}  // namespace

EdgeSnap::EdgeSnap(Size video, std::shared_ptr<Workers> workers)
    : size_(video), workers_(std::move(workers)), out_(video) {
    const auto pixels = static_cast<std::size_t>(video.width) * video.height;
    open_.resize(pixels);
    low_.resize(pixels);
    high_.resize(pixels);
}

const InverseDepthField& EdgeSnap::run(const InverseDepthField& in, const ImageView& frame,
                                       const PixelRect& where) {
    for (int y = where_.y0; y < where_.y1; ++y)
        out_.forgetRow(y, where_.x0, where_.x1);
    where_ = where;
    findEdges(in, where);
    workers_->forRange(where.y1 - where.y0, 8, [&](int first, int last) {
        for (int y = where.y0 + first; y < where.y0 + last; ++y)
            snapRow(in, frame, where, y);
    });
    return out_;
}

// Ranges along rows, then along columns.
void EdgeSnap::findEdges(const InverseDepthField& in, const PixelRect& where) {
    const int width = size_.width;
    workers_->forRange(where.y1 - where.y0, 8, [&](int first, int last) {
        for (int y = where.y0 + first; y < where.y0 + last; ++y) {
            const auto row = static_cast<std::size_t>(y) * width;
            for (int x = where.x0; x < where.x1; ++x) {
                float low = kLargest, high = -kLargest;
                for (int u = std::max(x - kBand, where.x0); u < std::min(x + kBand + 1, where.x1);
                     ++u) {
                    const bool known = isSound(in, row + u);
                    low = std::min(low, known ? in.rho[row + u] : kLargest);
                    high = std::max(high, known ? in.rho[row + u] : -kLargest);
                }
                low_[row + x] = low;
                high_[row + x] = high;
            }
        }
    });
    workers_->forRange(where.y1 - where.y0, 8, [&](int first, int last) {
        for (int y = where.y0 + first; y < where.y0 + last; ++y) {
            for (int x = where.x0; x < where.x1; ++x) {
                float low = kLargest, high = -kLargest;
                for (int v = std::max(y - kBand, where.y0); v < std::min(y + kBand + 1, where.y1);
                     ++v) {
                    const auto j = static_cast<std::size_t>(v) * width + x;
                    low = std::min(low, low_[j]);
                    high = std::max(high, high_[j]);
                }
                const auto i = static_cast<std::size_t>(y) * width + x;
                const bool known = isSound(in, i);
                const float noise = known ? kSigmas * std::sqrt(in.variance[i]) : 0.0F;
                const bool edge = high - low > kJump * high + noise;
                open_[i] = edge || !known ? 1 : 0;
            }
        }
    });
}

void EdgeSnap::take(const InverseDepthField& in, std::size_t i) {
    if (!isSound(in, i)) {
        out_.forget(i);
        return;
    }
    out_.rho[i] = in.rho[i];
    out_.variance[i] = in.variance[i];
    out_.filled[i] = in.filled[i];
}

void EdgeSnap::snapRow(const InverseDepthField& in, const ImageView& frame, const PixelRect& where,
                       int y) {
    const int width = size_.width;
    const Colours colours(frame);
    for (int x = where.x0; x < where.x1; ++x) {
        const auto i = static_cast<std::size_t>(y) * width + x;
        take(in, i);
        if (open_[i] == 0) continue;
        const int x0 = nextVoter(std::max(x - kVoteRadius, where.x0));
        const int y0 = nextVoter(std::max(y - kVoteRadius, where.y0));
        const int x1 = std::min(x + kVoteRadius + 1, where.x1);
        const int y1 = std::min(y + kVoteRadius + 1, where.y1);
        float low = kLargest, high = -kLargest;
        for (int v = y0; v < y1; v += kVoters)
            for (int u = x0; u < x1; u += kVoters) {
                const auto j = static_cast<std::size_t>(v) * width + u;
                if (open_[j] != 0) continue;
                low = std::min(low, in.rho[j]);
                high = std::max(high, in.rho[j]);
            }
        if (low > high) continue;
        const float middle = 0.5F * (low + high);
        const Colour own = colours.at(x, y);
        std::array<Side, 2> sides;
        for (int v = y0; v < y1; v += kVoters)
            for (int u = x0; u < x1; u += kVoters) {
                const auto j = static_cast<std::size_t>(v) * width + u;
                if (open_[j] != 0) continue;
                sides[in.rho[j] > middle ? 1 : 0].add(likeness(own, colours.at(u, v)), in.rho[j],
                                                      in.variance[j]);
            }
        const Side& side = sides[sides[1].weight > sides[0].weight ? 1 : 0];
        if (side.weight < kLeastWeight) continue;
        out_.rho[i] = side.rho / side.weight;
        out_.variance[i] = side.variance / side.weight;
        out_.filled[i] = 1;
    }
}

}  // namespace mfar
