#include "pipeline/models/environment_map.h"

#include "base/bounded_file.h"
#include "base/srgb.h"
#include "hal/image_codec.h"
#include "pipeline/models/gltf_model.h"
#include "pipeline/models/radiance_hdr.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace mfar {
namespace {

constexpr Size kMostKept{2048, 1024};
constexpr int kMostHdrWidth = 16384, kMostLdrWidth = 8192;

void requireLatLong(Size size, int mostWidth) {
    if (size.width < 2 || size.height < 1 || size.width > mostWidth || size.height > mostWidth)
        throw std::runtime_error(fmt::format(
            "the picture has {0}x{1} pixels; at least 2x1 and at most {2}x{2} are supported",
            size.width, size.height, mostWidth));
    if (std::abs(size.width - 2 * size.height) > std::max(size.width / 100, 1))
        throw std::runtime_error(
            fmt::format("the picture of {}x{} pixels is not a latitude-longitude picture, which "
                        "must be twice as wide as high",
                        size.width, size.height));
}

void requireMemory(Size size, std::size_t memory) {
    const std::size_t pixels = static_cast<std::size_t>(size.width) * size.height;
    const std::size_t kept =
        std::min<std::size_t>(pixels, static_cast<std::size_t>(kMostKept.width) * kMostKept.height);
    const std::size_t needed = 4 * pixels + sizeof(Eigen::Vector3f) * kept;
    constexpr std::size_t kMegabyte = std::size_t{1} << 20U;
    // The need is rounded up, so that the two numbers are never equal.
    if (needed > memory)
        throw std::runtime_error(fmt::format(
            "the picture of {}x{} pixels needs {} MB of memory, but only {} MB are left",
            size.width, size.height, (needed + kMegabyte - 1) / kMegabyte, memory / kMegabyte));
}

/// Averages rows as they are read, so that a large picture is never completely in memory as floats.
class RowAverage {
public:
    explicit RowAverage(Size from) : from_(from) {
        out_.size = {std::min(from.width, kMostKept.width),
                     std::min(from.height, kMostKept.height)};
        out_.radiance.resize(static_cast<std::size_t>(out_.size.width) * out_.size.height,
                             Eigen::Vector3f::Zero());
    }

    void add(int y, std::span<const Eigen::Vector3f> row) {
        const int to = target(y, from_.height, out_.size.height);
        Eigen::Vector3f* const sums =
            &out_.radiance[static_cast<std::size_t>(to) * out_.size.width];
        for (int x = 0; x < from_.width; ++x)
            sums[target(x, from_.width, out_.size.width)] += row[x];
    }

    Environment take() {
        const std::vector<float> rows = counts(from_.height, out_.size.height),
                                 columns = counts(from_.width, out_.size.width);
        for (std::size_t i = 0; i < out_.radiance.size(); ++i)
            out_.radiance[i] /= rows[i / columns.size()] * columns[i % columns.size()];
        return std::move(out_);
    }

private:
    static int target(int i, int from, int to) {
        return static_cast<int>(std::int64_t{i} * to / from);
    }
    static std::vector<float> counts(int from, int to) {
        std::vector<float> out(static_cast<std::size_t>(to));
        for (int i = 0; i < from; ++i)
            ++out[target(i, from, to)];
        return out;
    }

    Size from_;
    Environment out_;
};

Environment readHdr(std::span<const std::uint8_t> bytes, std::size_t memory) {
    std::optional<RowAverage> average;
    readRadianceHdr(
        bytes,
        [&](Size size) {
            requireLatLong(size, kMostHdrWidth);
            requireMemory(
                {std::min(size.width, kMostKept.width), std::min(size.height, kMostKept.height)},
                memory);
            average.emplace(size);
        },
        [&](int y, std::span<const Eigen::Vector3f> row) { average->add(y, row); });
    return average->take();
}

Environment readLdr(std::span<const std::uint8_t> bytes, std::size_t memory) {
    Size size;
    std::vector<std::uint8_t> rgba;
    decodeImage(bytes, [&](Size found) -> PixelTarget {
        requireLatLong(found, kMostLdrWidth);
        requireMemory(found, memory);
        size = found;
        rgba.resize(std::size_t{4} * size.width * size.height);
        return {rgba.data(), std::size_t{4} * size.width};
    });
    RowAverage average(size);
    std::vector<Eigen::Vector3f> row(static_cast<std::size_t>(size.width));
    const std::array<float, 256>& linear = linearOfSrgbByte();
    for (int y = 0; y < size.height; ++y) {
        const std::uint8_t* p = &rgba[std::size_t{4} * size.width * y];
        for (Eigen::Vector3f& value : row) {
            value = {linear[p[0]], linear[p[1]], linear[p[2]]};
            p += 4;
        }
        average.add(y, row);
    }
    return average.take();
}

}  // namespace

Environment parseEnvironment(std::span<const std::uint8_t> bytes, const std::string& name,
                             std::size_t memory) {
    try {
        if (isRadianceHdr(bytes)) return readHdr(bytes, memory);
        if (!isPngOrJpeg(bytes))
            throw std::runtime_error("is neither a Radiance picture (.hdr), PNG nor JPEG");
        return readLdr(bytes, memory);
    } catch (const std::runtime_error& error) {
        throw ModelError(fmt::format("{}: {}", name, error.what()));
    }
}

Environment loadEnvironment(const std::filesystem::path& file, std::size_t memory) {
    std::vector<std::uint8_t> bytes;
    try {
        bytes = boundedFile(file, memory / 2);
    } catch (const std::runtime_error& error) {
        throw ModelError(fmt::format("{}: {}", file.string(), error.what()));
    }
    return parseEnvironment(bytes, file.string(), memory - bytes.size());
}

Eigen::Vector3f environmentDirection(float u, float v) {
    constexpr float kPi = std::numbers::pi_v<float>;
    // u = 0 is the direction -x, and u = 3/4 is +y.
    const float longitude = 2 * kPi * u + kPi, fromUp = kPi * v;
    return {std::cos(longitude) * std::sin(fromUp), std::sin(longitude) * std::sin(fromUp),
            std::cos(fromUp)};
}

Environment environmentOf(Size size,
                          const std::function<Eigen::Vector3f(const Eigen::Vector3f&)>& radiance) {
    Environment out{size, {}};
    out.radiance.reserve(static_cast<std::size_t>(size.width) * size.height);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            out.radiance.push_back(radiance(environmentDirection(
                (static_cast<float>(x) + 0.5F) / static_cast<float>(size.width),
                (static_cast<float>(y) + 0.5F) / static_cast<float>(size.height))));
    return out;
}

}  // namespace mfar
