#include "pipeline/epipolar/patch_match.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

namespace mfar {
namespace {

// Width and height of a block [px]. Structure tensors are summed over blocks, and a patch consists
// of two by two blocks.
constexpr int kBlock = kPatch / 2;
// The picture is divided into at least this number of equal parts, if it is large enough. A part
// consists of at least two by two blocks.
constexpr int kPlaces = 300;
constexpr int kPixels = kPatch * kPatch;
// A match is valid if its correlation is above kLeastScore. It is ambiguous if a position that is
// more than kRivalDistance [px] away has a correlation that is lower by less than kRival.
constexpr double kLeastScore = 0.75;
constexpr double kRival = 0.06;
constexpr double kRivalDistance = 2.5;
// Limits of the refinement of a match by inverse-compositional steps. There are at most kMatchSteps
// steps. They end after a step that is shorter than kShortStep [px]. They must lead less than
// kLongestWay [px] away from the start along each axis.
constexpr int kMatchSteps = 6;
constexpr float kLongestWay = 1.5F, kShortStep = 0.01F;
constexpr double kFar = 1e6;

const Eigen::Vector2d kHalf = Eigen::Vector2d::Constant(0.5 * (kPatch - 1));

using Grey = std::array<float, kPixels>;

struct Tensor {
    int xx = 0, xy = 0, yy = 0;

    Tensor& operator+=(const Tensor& b) {
        xx += b.xx;
        xy += b.xy;
        yy += b.yy;
        return *this;
    }
    [[nodiscard]] double least() const {
        const double half = 0.5 * (xx + yy), apart = 0.5 * (xx - yy);
        return half - std::hypot(apart, static_cast<double>(xy));
    }
};

/// Structure tensors of all blocks of a picture. They are computed from central differences, which
/// are twice the gradient. Block (i, j) starts at pixel 1 + kBlock (i, j), so all pixels for the
/// differences are inside the picture.
struct TensorField {
    int width = 0, height = 0;
    std::vector<Tensor> blocks;

    explicit TensorField(const LumaImage& picture)
        : width((picture.size.width - 2) / kBlock), height((picture.size.height - 2) / kBlock),
          blocks(static_cast<std::size_t>(std::max(width, 0)) * std::max(height, 0)) {
        for (int y = 1; y <= kBlock * height; ++y) {
            const std::uint8_t *a = picture.row(y - 1), *b = picture.row(y),
                               *c = picture.row(y + 1);
            Tensor* out = blocks.data() + static_cast<std::ptrdiff_t>((y - 1) / kBlock) * width;
            for (int x = 1; x <= kBlock * width; ++x) {
                const int dx = b[x + 1] - b[x - 1], dy = c[x] - a[x];
                out[(x - 1) / kBlock] += Tensor{dx * dx, dx * dy, dy * dy};
            }
        }
    }
    [[nodiscard]] double leastAt(int i, int j) const {
        const Tensor* b = blocks.data() + static_cast<std::ptrdiff_t>(j) * width + i;
        Tensor sum = b[0];
        ((sum += b[1]) += b[width]) += b[width + 1];
        return sum.least();
    }
};

struct Sums {
    int s = 0, ss = 0, st = 0;

    Sums(const std::uint8_t* a, int aStride, const std::uint8_t* b, int bStride) {
        for (int y = 0; y < kPatch; ++y, a += aStride, b += bStride) {
            for (int x = 0; x < kPatch; ++x) {
                s += b[x];
                ss += b[x] * b[x];
                st += a[x] * b[x];
            }
        }
    }
    /// Returns the variance of the second patch `b`, multiplied by the square of its number of
    /// pixels.
    [[nodiscard]] double power() const { return 1.0 * kPixels * ss - 1.0 * s * s; }
};

class Correlation {
public:
    Correlation(const LumaImage& picture, PatchPlace place)
        : own_(picture.row(place.y) + place.x), stride_(picture.size.width),
          self_(own_, stride_, own_, stride_) {}

    /// Returns the correlation with the patch at (x, y) of `picture`, in [-1, 1]. If one of the
    /// patches is uniform, returns 0.
    [[nodiscard]] double with(const LumaImage& picture, int x, int y) const {
        const Sums sums(own_, stride_, picture.row(y) + x, picture.size.width);
        const double powers = self_.power() * sums.power();
        if (!(powers > 0)) return 0;
        return (1.0 * kPixels * sums.st - 1.0 * self_.s * sums.s) / std::sqrt(powers);
    }

private:
    const std::uint8_t* own_;
    int stride_;
    Sums self_;
};

struct Candidate {
    int x = 0, y = 0;
    double score = -1;
};

float withoutMean(Grey& values) {
    float sum = 0, squares = 0;
    for (const float v : values)
        sum += v;
    for (float& v : values) {
        v -= sum / kPixels;
        squares += v * v;
    }
    return std::sqrt(squares);
}

/// A patch and its gradient, each minus its mean, and the inverse of the structure tensor.
class Template {
public:
    Template(const LumaImage& picture, PatchPlace place) {
        const int stride = picture.size.width;
        for (int k = 0; k < kPixels; ++k) {
            const std::uint8_t* p = picture.row(place.y + k / kPatch) + place.x + k % kPatch;
            grey_[k] = p[0];
            dx_[k] = 0.5F * static_cast<float>(p[1] - p[-1]);
            dy_[k] = 0.5F * static_cast<float>(p[stride] - p[-stride]);
        }
        norm_ = withoutMean(grey_);
        (void)withoutMean(dx_);
        (void)withoutMean(dy_);
        Eigen::Matrix2f tensor = Eigen::Matrix2f::Zero();
        for (int k = 0; k < kPixels; ++k) {
            const Eigen::Vector2f g(dx_[k], dy_[k]);
            tensor += g * g.transpose();
        }
        if (tensor.determinant() > 1) inverse_ = tensor.inverse();
    }

    /// Returns the displacement [px] of a sampled patch from its true position. `seen` is the
    /// sampled patch minus its mean, `norm` the norm of `seen`.
    [[nodiscard]] Eigen::Vector2f step(const Grey& seen, float norm) const {
        const float gain = norm_ / norm;
        Eigen::Vector2f sum = Eigen::Vector2f::Zero();
        for (int k = 0; k < kPixels; ++k)
            sum += (gain * seen[k] - grey_[k]) * Eigen::Vector2f(dx_[k], dy_[k]);
        return inverse_ * sum;
    }

private:
    Grey grey_{}, dx_{}, dy_{};
    float norm_ = 0;
    Eigen::Matrix2f inverse_ = Eigen::Matrix2f::Zero();
};

/// Samples the patch that begins at `first` bilinearly. Subtracts the mean and returns the norm.
float sample(const LumaImage& picture, const Eigen::Vector2f& first, Grey& out) {
    const int x = static_cast<int>(first.x()), y = static_cast<int>(first.y());
    const float u = first.x() - static_cast<float>(x), v = first.y() - static_cast<float>(y);
    for (int j = 0; j < kPatch; ++j) {
        const std::uint8_t *a = picture.row(y + j) + x, *b = picture.row(y + j + 1) + x;
        for (int i = 0; i < kPatch; ++i) {
            const float top = static_cast<float>(a[i]) + u * static_cast<float>(a[i + 1] - a[i]);
            const float low = static_cast<float>(b[i]) + u * static_cast<float>(b[i + 1] - b[i]);
            out[j * kPatch + i] = top + v * (low - top);
        }
    }
    return withoutMean(out);
}

}  // namespace

std::vector<PatchPlace> texturedPlaces(const LumaImage& picture, double noise) {
    const TensorField field(picture);
    std::vector<PatchPlace> out;
    if (field.width < 2 || field.height < 2) return out;
    const int right = field.width - 1, bottom = field.height - 1;
    const int cell = std::max(2, static_cast<int>(std::sqrt(1.0 * right * bottom / kPlaces)));
    // A patch with less texture than this is skipped. Texture is the sum of squared differences
    // between pixels two px apart, in the direction in which this sum is smallest. The limit is
    // twice the sum that noise alone causes, plus a margin of 8 grey levels^2 per pixel.
    const double least = kPixels * (4 * noise * noise + 8);
    for (int j0 = 0; j0 < bottom; j0 += cell) {
        for (int i0 = 0; i0 < right; i0 += cell) {
            double best = least;
            std::optional<PatchPlace> place;
            for (int j = j0; j < std::min(j0 + cell, bottom); ++j) {
                for (int i = i0; i < std::min(i0 + cell, right); ++i) {
                    const double texture = field.leastAt(i, j);
                    if (!(texture > best)) continue;
                    best = texture;
                    place = {1 + kBlock * i, 1 + kBlock * j};
                }
            }
            if (place) out.push_back(*place);
        }
    }
    return out;
}

// True if all pixels of the patch at (x, y) are valid, and also the row below and the column to the
// right, which bilinear samples need. Testing the four corners suffices, because the valid area is
// nearly convex.
bool PatchMatcher::shows(int x, int y) const {
    const int w = to_.size.width;
    if (x < 0 || y < 0 || x + kPatch >= w || y + kPatch >= to_.size.height) return false;
    const std::uint8_t* corner = seen_.data() + static_cast<std::ptrdiff_t>(y) * w + x;
    const std::uint8_t* below = corner + static_cast<std::ptrdiff_t>(kPatch) * w;
    return corner[0] != 0 && corner[kPatch] != 0 && below[0] != 0 && below[kPatch] != 0;
}

std::optional<Eigen::Vector2d> PatchMatcher::find(PatchPlace place,
                                                  const PatchWindow& window) const {
    const Eigen::Vector2d across(-window.along.y(), window.along.x());
    const Correlation correlation(from_, place);
    std::vector<Candidate> tried;
    Candidate best;
    for (int b = -window.acrossSteps; b <= window.acrossSteps; ++b) {
        for (int a = -window.alongSteps; a <= window.alongSteps; ++a) {
            const Eigen::Vector2d first = window.middle - kHalf + a * window.along + b * across;
            if (!(first.cwiseAbs().maxCoeff() < kFar)) continue;
            Candidate c{static_cast<int>(std::lround(first.x())),
                        static_cast<int>(std::lround(first.y()))};
            if (!shows(c.x, c.y)) continue;
            c.score = correlation.with(to_, c.x, c.y);
            tried.push_back(c);
            if (c.score > best.score) best = c;
        }
    }
    if (!(best.score > kLeastScore)) return std::nullopt;
    for (const Candidate& c : tried)
        if (c.score > best.score - kRival &&
            std::hypot(c.x - best.x, c.y - best.y) > kRivalDistance)
            return std::nullopt;
    return Eigen::Vector2d(best.x, best.y) + kHalf;
}

std::optional<Eigen::Vector2d> PatchMatcher::polish(PatchPlace place,
                                                    const Eigen::Vector2d& near) const {
    const Template patch(from_, place);
    const Eigen::Vector2f start = (near - kHalf).cast<float>();
    Eigen::Vector2f first = start;
    Grey seen;
    for (int k = 0; k < kMatchSteps; ++k) {
        if (!((first - start).cwiseAbs().maxCoeff() < kLongestWay)) return std::nullopt;
        const Eigen::Vector2f corner = first.array().floor();
        if (!(corner.cwiseAbs().maxCoeff() < static_cast<float>(kFar)) ||
            !shows(static_cast<int>(corner.x()), static_cast<int>(corner.y())))
            return std::nullopt;
        const float norm = sample(to_, first, seen);
        if (!(norm > 1)) return std::nullopt;
        const Eigen::Vector2f step = patch.step(seen, norm);
        first -= step;
        if (step.squaredNorm() < kShortStep * kShortStep) break;
    }
    if (!((first - start).cwiseAbs().maxCoeff() < kLongestWay)) return std::nullopt;
    return first.cast<double>() + kHalf;
}

}  // namespace mfar
