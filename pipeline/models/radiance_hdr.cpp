#include "pipeline/models/radiance_hdr.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace mfar {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

[[noreturn]] void endsEarly() {
    throw std::runtime_error("the file ends before the picture is complete");
}

class HdrBytes {
public:
    explicit HdrBytes(std::span<const std::uint8_t> bytes) : left_(bytes) {}

    std::uint8_t byte() {
        if (left_.empty()) endsEarly();
        const std::uint8_t value = left_.front();
        left_ = left_.subspan(1);
        return value;
    }
    Rgbe pixel() { return {byte(), byte(), byte(), byte()}; }
    std::string_view line() {
        constexpr std::size_t kLongest = 2048;
        const auto end = std::find(left_.begin(), left_.end(), '\n');
        const auto length = static_cast<std::size_t>(end - left_.begin());
        if (end == left_.end() || length > kLongest)
            throw std::runtime_error("the header of the Radiance picture is invalid");
        const std::string_view text(reinterpret_cast<const char*>(left_.data()), length);
        left_ = left_.subspan(length + 1);
        return text;
    }
    /// Returns the next four bytes without consuming them.
    [[nodiscard]] std::optional<Rgbe> peek() const {
        if (left_.size() < 4) return std::nullopt;
        return Rgbe{left_[0], left_[1], left_[2], left_[3]};
    }
    void skip(std::size_t count) { left_ = left_.subspan(count); }

private:
    std::span<const std::uint8_t> left_;
};

std::optional<double> numberIn(std::string_view text) {
    double value = 0;
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end.ec != std::errc()) return std::nullopt;
    return value;
}

/// Reads the header up to the empty line. Returns the product of all EXPOSURE values.
double readHeader(HdrBytes& in) {
    double exposure = 1;
    for (std::string_view line = in.line(); !line.empty(); line = in.line()) {
        if (line.starts_with("FORMAT=") && !line.starts_with("FORMAT=32-bit_rle_rgbe"))
            throw std::runtime_error(
                fmt::format("{} is not supported; expected FORMAT=32-bit_rle_rgbe", line));
        if (!line.starts_with("EXPOSURE=")) continue;
        exposure *= numberIn(line.substr(9)).value_or(0);
        if (!(exposure >= 1e-9 && exposure <= 1e9))
            throw std::runtime_error("the product of all EXPOSURE values must be from 1e-9 to 1e9");
    }
    return exposure;
}

Size readResolution(std::string_view line) {
    Size size;
    const char* const end = line.data() + line.size();
    if (line.starts_with("-Y ")) {
        const auto height = std::from_chars(line.data() + 3, end, size.height);
        const std::string_view rest(height.ptr, static_cast<std::size_t>(end - height.ptr));
        if (rest.starts_with(" +X ")) std::from_chars(rest.data() + 4, end, size.width);
    }
    if (size.width < 1 || size.height < 1)
        throw std::runtime_error(fmt::format(
            "the row order \"{}\" is not supported; expected \"-Y HEIGHT +X WIDTH\"", line));
    return size;
}

/// Reads a row in which the four components are stored one after the other, each with run-length
/// coding.
void readSplitRow(HdrBytes& in, std::span<Rgbe> row) {
    constexpr int kRun = 128;
    for (int channel = 0; channel < 4; ++channel) {
        for (std::size_t x = 0; x < row.size();) {
            const int code = in.byte();
            const auto count = static_cast<std::size_t>(code > kRun ? code - kRun : code);
            if (count == 0 || count > row.size() - x)
                throw std::runtime_error("a row of pixels is invalid: wrong run length");
            const std::uint8_t same = code > kRun ? in.byte() : std::uint8_t{0};
            for (std::size_t i = 0; i < count; ++i)
                row[x++][channel] = code > kRun ? same : in.byte();
        }
    }
}

/// Reads a row that is stored pixel by pixel. The code (1, 1, 1, n) repeats the last pixel n times.
/// If several codes follow each other, the second repeats it 256 n times with its own n, the third
/// 65536 n times, and so on.
void readOldRow(HdrBytes& in, std::span<Rgbe> row) {
    unsigned shift = 0;
    for (std::size_t x = 0; x < row.size();) {
        const Rgbe pixel = in.pixel();
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            row[x++] = pixel;
            shift = 0;
            continue;
        }
        const std::size_t count = shift < 32 ? std::size_t{pixel[3]} << shift : 0;
        if (x == 0 || count > row.size() - x)
            throw std::runtime_error("a row of pixels is invalid: wrong run length");
        std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(x), count, row[x - 1]);
        x += count;
        shift += 8;
    }
}

void readRow(HdrBytes& in, std::span<Rgbe> row) {
    constexpr std::size_t kLeastSplit = 8, kMostSplit = 32767;
    const std::optional<Rgbe> mark = in.peek();
    if (!mark) endsEarly();
    const bool split = row.size() >= kLeastSplit && row.size() <= kMostSplit && (*mark)[0] == 2 &&
                       (*mark)[1] == 2 && (*mark)[2] < 128;
    if (!split) return readOldRow(in, row);
    if ((std::size_t{(*mark)[2]} << 8U | (*mark)[3]) != row.size())
        throw std::runtime_error("a row of pixels is invalid: it is not as wide as the picture");
    in.skip(4);
    readSplitRow(in, row);
}

Eigen::Vector3f valueOf(const Rgbe& pixel, float scale) {
    constexpr float kBrightest = 1e7F;  // for comparison: a studio lamp has 1, the sun 1e4
    if (pixel[3] == 0) return Eigen::Vector3f::Zero();
    const float unit = std::ldexp(scale, pixel[3] - 136);
    const Eigen::Vector3f mantissa(pixel[0], pixel[1], pixel[2]);
    return (unit * (mantissa.array() + 0.5F)).min(kBrightest);
}

}  // namespace

bool isRadianceHdr(std::span<const std::uint8_t> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return text.starts_with("#?RADIANCE") || text.starts_with("#?RGBE");
}

void readRadianceHdr(std::span<const std::uint8_t> bytes, const std::function<void(Size)>& size,
                     const std::function<void(int, std::span<const Eigen::Vector3f>)>& row) {
    HdrBytes in(bytes);
    const auto scale = static_cast<float>(1 / readHeader(in));
    const Size picture = readResolution(in.line());
    size(picture);
    std::vector<Rgbe> pixels(static_cast<std::size_t>(picture.width));
    std::vector<Eigen::Vector3f> values(pixels.size());
    for (int y = 0; y < picture.height; ++y) {
        readRow(in, pixels);
        std::transform(pixels.begin(), pixels.end(), values.begin(),
                       [&](const Rgbe& pixel) { return valueOf(pixel, scale); });
        row(y, values);
    }
}

}  // namespace mfar
