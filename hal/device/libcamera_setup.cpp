#include "hal/device/libcamera_setup.h"

#include "hal/device/field_of_view.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace mfar {
namespace {

using libcamera::CameraConfiguration;
using libcamera::StreamConfiguration;

struct Offer {
    libcamera::PixelFormat theirs;
    PixelFormat ours;
};

// In order of preference. libcamera's names of RGB formats list the colours from the last byte to
// the first.
const std::array<Offer, 5> kPreferred{{{libcamera::formats::NV12, PixelFormat::Nv12},
                                       {libcamera::formats::YUV420, PixelFormat::Yuv420},
                                       {libcamera::formats::YUYV, PixelFormat::Yuyv},
                                       {libcamera::formats::XRGB8888, PixelFormat::Bgra8},
                                       {libcamera::formats::XBGR8888, PixelFormat::Rgba8}}};

struct SensorMode {
    libcamera::Size size;
    unsigned bitDepth = 0;
};

bool offers(const StreamConfiguration& stream, const libcamera::PixelFormat& format) {
    const auto formats = stream.formats().pixelformats();
    return std::ranges::find(formats, format) != formats.end();
}

std::unique_ptr<CameraConfiguration> generate(libcamera::Camera& camera,
                                              const LibcameraOptions& options) {
    const auto role =
        options.still ? libcamera::StreamRole::StillCapture : libcamera::StreamRole::VideoRecording;
    auto configuration = camera.generateConfiguration({role});
    if (!configuration || configuration->empty())
        throw std::runtime_error(
            fmt::format("camera '{}' has no stream for pictures", camera.id()));
    return configuration;
}

[[noreturn]] void failOnFormat(libcamera::Camera& camera, const LibcameraOptions& options,
                               const StreamConfiguration& stream,
                               const std::vector<std::string>& became) {
    const Size size = options.size;
    std::vector<std::string> formats;
    for (const auto& format : stream.formats().pixelformats())
        formats.push_back(format.toString());
    if (!became.empty())
        throw std::runtime_error(fmt::format("camera '{}' does not support {}x{}: {}", camera.id(),
                                             size.width, size.height, fmt::join(became, ", ")));
    const bool jpeg = offers(stream, libcamera::formats::MJPEG);
    throw std::runtime_error(fmt::format(
        "camera '{}' offers the pixel formats {}, none of which mfar supports{}", camera.id(),
        fmt::join(formats, ", "), jpeg ? "; for MJPEG use driver \"v4l2\"" : ""));
}

struct Chosen {
    std::unique_ptr<CameraConfiguration> configuration;
    PixelFormat format = PixelFormat::Nv12;
};

/// Returns a valid configuration of exactly the wanted size, in the most preferred format that
/// works. If there is no such configuration, returns nothing if `mode` is set and throws if it is
/// not set.
std::optional<Chosen> choose(libcamera::Camera& camera, const LibcameraOptions& options,
                             const std::optional<SensorMode>& mode) {
    Chosen chosen{generate(camera, options), {}};
    CameraConfiguration& configuration = *chosen.configuration;
    const libcamera::Size size(static_cast<unsigned>(options.size.width),
                               static_cast<unsigned>(options.size.height));
    std::vector<std::string> became;
    for (const Offer& offer : kPreferred) {
        StreamConfiguration& stream = configuration.at(0);
        if (!offers(stream, offer.theirs)) continue;
        stream.pixelFormat = offer.theirs;
        stream.size = size;
        stream.bufferCount = options.buffers;
        if (mode) libcamera_compat::setSensorMode(configuration, mode->size, mode->bitDepth);
        const bool valid = configuration.validate() != CameraConfiguration::Invalid;
        const StreamConfiguration& result = configuration.at(0);
        if (valid && result.pixelFormat == offer.theirs && result.size == size) {
            chosen.format = offer.ours;
            return chosen;
        }
        became.push_back(fmt::format("{} {}", offer.theirs.toString(),
                                     valid ? "becomes " + result.toString() : "is refused"));
    }
    if (mode) return std::nullopt;
    failOnFormat(camera, options, configuration.at(0), became);
}

/// Returns the bit depth of a raw format, e.g. 10 for "SRGGB10_CSI2P" and "R10", or 0 for other
/// formats.
unsigned bitDepth(const std::string& format) {
    const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
    const bool bayer = format.starts_with('S');
    const bool mono = format.size() > 1 && format[0] == 'R' && isDigit(format[1]);
    if (!bayer && !mono) return 0;
    unsigned depth = 0;
    for (auto c = std::ranges::find_if(format, isDigit); c != format.end() && isDigit(*c); ++c)
        depth = std::min(depth * 10 + static_cast<unsigned>(*c - '0'), 64U);
    return depth;
}

/// Returns the sensor modes that are at least as large as `size`, smallest first. Returns an empty
/// list if this version of libcamera does not let its caller choose the mode.
std::vector<SensorMode> sensorModes(libcamera::Camera& camera, Size size) {
    std::vector<SensorMode> modes;
    if constexpr (!libcamera_compat::hasSensorConfiguration()) return modes;
    const auto raw = camera.generateConfiguration({libcamera::StreamRole::Raw});
    if (!raw || raw->empty()) return modes;
    const auto& formats = raw->at(0).formats();
    for (const auto& format : formats.pixelformats()) {
        const unsigned depth = bitDepth(format.toString());
        for (const libcamera::Size& mode : formats.sizes(format))
            if (depth > 0 && mode.width >= static_cast<unsigned>(size.width) &&
                mode.height >= static_cast<unsigned>(size.height))
                modes.push_back({mode, depth});
    }
    // Among modes of equal size, greater bit depths come first. They make a mode slower, so the
    // caller may have to use a later mode in order to reach the frame rate.
    std::ranges::sort(modes, {}, [](const SensorMode& mode) {
        return std::pair(std::uint64_t{mode.size.width} * mode.size.height, 64 - mode.bitDepth);
    });
    return modes;
}

bool reachesRate(const libcamera::Camera& camera, double rateHz) {
    const auto& controls = camera.controls();
    const auto limits = controls.find(&libcamera::controls::FrameDurationLimits);
    if (limits == controls.end() || rateHz <= 0) return true;
    const libcamera::ControlValue& least = limits->second.min();
    if (least.type() != libcamera::ControlTypeInteger64 || least.isArray()) return true;
    return static_cast<double>(least.get<std::int64_t>()) <= 1e6 / rateHz * 1.01;
}

std::optional<std::string> cropFault(const libcamera::Camera& camera,
                                     const LibcameraOptions& options) {
    return cropFault(camera, camera.properties().get(libcamera::properties::ScalerCropMaximum),
                     options);
}

void apply(libcamera::Camera& camera, CameraConfiguration& configuration) {
    if (const int error = camera.configure(&configuration); error != 0)
        throw std::runtime_error(
            fmt::format("camera '{}' cannot be configured (error {})", camera.id(), -error));
}

/// Chooses the first sensor mode that shows the whole field of view and reaches the frame rate. If
/// there is none, libcamera chooses the mode.
Chosen chooseMode(libcamera::Camera& camera, const LibcameraOptions& options) {
    for (const SensorMode& mode : sensorModes(camera, options.size)) {
        auto chosen = choose(camera, options, mode);
        if (!chosen || camera.configure(chosen->configuration.get()) != 0) continue;
        if (!cropFault(camera, options) && reachesRate(camera, options.rateHz))
            return std::move(*chosen);
    }
    auto chosen = choose(camera, options, std::nullopt);
    apply(camera, *chosen->configuration);
    if (const auto fault = cropFault(camera, options)) throw std::runtime_error(*fault);
    return std::move(*chosen);
}

PictureLayout layoutOf(const StreamConfiguration& stream, PixelFormat format, Size size) {
    PictureLayout layout{size, format, stream.stride, YuvMatrix::Bt601, YuvRange::Limited};
    if (!stream.colorSpace) return layout;
    using Encoding = libcamera::ColorSpace::YcbcrEncoding;
    const Encoding encoding = stream.colorSpace->ycbcrEncoding;
    if (encoding == Encoding::Rec709 || encoding == Encoding::Rec2020)
        layout.matrix = YuvMatrix::Bt709;
    if (stream.colorSpace->range == libcamera::ColorSpace::Range::Full)
        layout.range = YuvRange::Full;
    return layout;
}

}  // namespace

ConfiguredCamera configureLibcamera(libcamera::Camera& camera, const LibcameraOptions& options) {
    Chosen chosen = chooseMode(camera, options);
    const PictureLayout layout = layoutOf(chosen.configuration->at(0), chosen.format, options.size);
    return {std::move(chosen.configuration), layout};
}

ControlValues controlsFor(const libcamera::Camera& camera, const LibcameraOptions& options) {
    const auto& known = camera.controls();
    NamedValues wanted;
    if (options.rateHz > 0 && hasControl(known, "FrameDurationLimits")) {
        const auto us = std::llround(1e6 / options.rateHz);
        wanted.emplace_back("FrameDurationLimits", fmt::format("{},{}", us, us));
    }
    wanted.insert(wanted.end(), options.controls.begin(), options.controls.end());
    return parseControls(known, withManualModes(known, std::move(wanted)));
}

std::optional<Size> activePixels(const libcamera::Camera& camera) {
    const auto areas = camera.properties().get(libcamera::properties::PixelArrayActiveAreas);
    if (!areas || areas->empty()) return std::nullopt;
    const libcamera::Rectangle& first = (*areas)[0];
    return Size{static_cast<int>(first.width), static_cast<int>(first.height)};
}

std::optional<std::string> cropFault(const libcamera::Camera& camera,
                                     const std::optional<libcamera::Rectangle>& crop,
                                     const LibcameraOptions& options) {
    const std::optional<Size> active = activePixels(camera);
    if (options.allowCrop || !crop || !active) return std::nullopt;
    const Size shown{static_cast<int>(crop->width), static_cast<int>(crop->height)};
    if (showsWholeField(shown, *active, options.size)) return std::nullopt;
    return fmt::format("camera '{}' would show only {}x{} of its {}x{} pixels, a part of its field "
                       "of view; choose another size or set allow_crop = true",
                       camera.id(), shown.width, shown.height, active->width, active->height);
}

}  // namespace mfar
