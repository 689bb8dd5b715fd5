#include "hal/device/display_host_scaler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace mfar {
namespace {

constexpr std::uint32_t kBlack = 0xff000000;
constexpr int kFixedOne = 65535;
// Number of strips of a picture per thread. If a thread is interrupted, the other threads process
// its remaining strips.
constexpr int kStripsPerThread = 2;

// Computes sum += pixel * weight in 8.8 fixed point. It uses only the upper 16 bits of a product of
// two 16-bit numbers, because SIMD units compute these with one instruction.
void addRow(const std::uint8_t* __restrict pixels, std::uint16_t weight,
            std::uint16_t* __restrict sum, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const auto wide = static_cast<std::uint16_t>(pixels[i] << 8);
        const std::uint32_t product = static_cast<std::uint32_t>(wide) * weight;
        sum[i] = static_cast<std::uint16_t>(sum[i] + (product >> 16));
    }
}

void toReal(const std::uint16_t* __restrict sum, float* __restrict real, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        real[i] = static_cast<float>(sum[i]);
}

}  // namespace

// Weights of pixels outside the picture are added to the weight of the edge pixel.
HostScaler::Axis::Axis(int from, int to) {
    const double scale = static_cast<double>(from) / to, width = std::max(scale, 1.0);
    footprints.reserve(static_cast<std::size_t>(to));
    for (int i = 0; i < to; ++i) {
        const double lo = (i + 0.5) * scale - width / 2, hi = lo + width;
        const int first = std::clamp(static_cast<int>(std::floor(lo)), 0, from - 1);
        const int last = std::clamp(static_cast<int>(std::ceil(hi)) - 1, first, from - 1);
        footprints.push_back({first, last - first + 1, weights.size()});
        int before = 0;
        for (int p = first; p <= last; ++p) {
            const double begin = p == first ? lo : p, end = p == last ? hi : p + 1.0;
            weights.push_back(static_cast<float>((end - begin) / width));
            // Rounds the running sums of the weights, so that the weights add up to exactly
            // kFixedOne.
            const int upTo = static_cast<int>(std::lround((end - lo) / width * kFixedOne));
            fixed.push_back(static_cast<std::uint16_t>(upTo - before));
            before = upTo;
        }
    }
}

void HostScaler::prepare(Size picture) {
    if (!workers_) workers_ = std::make_unique<Workers>();
    picture_ = picture;
    to_ = letterbox(picture, screen_);
    columns_ = Axis(picture.width, to_.size.width);
    rows_ = Axis(picture.height, to_.size.height);
    lines_.assign(static_cast<std::size_t>(kStripsPerThread * workers_->count()),
                  Line(picture.width));
    out_ = AlignedRows<std::uint32_t>(screen_);
    for (int y = 0; y < screen_.height; ++y)
        std::fill_n(out_[y], screen_.width, kBlack);
}

Rows<const std::uint32_t> HostScaler::scaled(const Rows<const std::uint32_t>& picture) {
    if (picture.size == screen_) return picture;
    if (picture.size != picture_) prepare(picture.size);
    if (to_.size == picture.size) {
        for (int y = 0; y < picture.size.height; ++y)
            std::copy_n(picture[y], picture.size.width, out_[to_.y + y] + to_.x);
        return out_.rows();
    }
    const int strips = static_cast<int>(lines_.size()), height = to_.size.height;
    workers_->forRange(strips, 1, [&](int first, int last) {
        for (int row = height * first / strips; row < height * last / strips; ++row)
            scaleRow(picture, row, lines_[static_cast<std::size_t>(first)]);
    });
    return out_.rows();
}

// Averages the footprint's rows first, because the resulting single row stays in the cache. Then
// averages pixels along that row.
void HostScaler::scaleRow(const Rows<const std::uint32_t>& picture, int row, Line& line) {
    const Footprint& down = rows_.footprints[static_cast<std::size_t>(row)];
    // addRow() truncates each product, which loses half a unit on average. So the sums begin with
    // the expected loss, limited to 255 against overflow.
    std::ranges::fill(line.fixed, static_cast<std::uint16_t>(std::min(down.taps / 2, 255)));
    for (int tap = 0; tap < down.taps; ++tap)
        addRow(reinterpret_cast<const std::uint8_t*>(picture[down.first + tap]),
               rows_.fixed[down.begin + static_cast<std::size_t>(tap)], line.fixed.data(),
               line.fixed.size());
    toReal(line.fixed.data(), line.real.data(), line.real.size());
    std::uint32_t* out = out_[to_.y + row] + to_.x;
    for (int x = 0; x < to_.size.width; ++x) {
        const Footprint& across = columns_.footprints[static_cast<std::size_t>(x)];
        const float* pixel = &line.real[static_cast<std::size_t>(across.first) * 4];
        const float* weight = &columns_.weights[across.begin];
        // The sums begin with half a grey level in 8.8 fixed point, for rounding.
        std::array<float, 4> sum{128, 128, 128, 128};
        for (int tap = 0; tap < across.taps; ++tap, pixel += 4)
            for (std::size_t k = 0; k < 4; ++k)
                sum[k] += weight[tap] * pixel[k];
        std::uint32_t rgba = 0;
        for (std::size_t k = 0; k < 4; ++k)
            rgba |= static_cast<std::uint32_t>(sum[k]) >> 8 << (8 * k);
        out[x] = rgba;
    }
}

}  // namespace mfar
