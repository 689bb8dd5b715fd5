#include "hal/device/v4l2_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <stdexcept>

namespace mfar {
namespace {

constexpr std::uint32_t kMostSide = 65535;  // [px]; larger reported widths and heights are clamped
constexpr int kMostOffers = 512;            // the list of a faulty driver may never end

constexpr std::array kUsable{
    V4l2PixelFormat{V4L2_PIX_FMT_NV12, PixelFormat::Nv12},
    V4l2PixelFormat{V4L2_PIX_FMT_NV12M, PixelFormat::Nv12, false, true},
    V4l2PixelFormat{V4L2_PIX_FMT_YUV420, PixelFormat::Yuv420},
    V4l2PixelFormat{V4L2_PIX_FMT_YUV420M, PixelFormat::Yuv420, false, true},
    V4l2PixelFormat{V4L2_PIX_FMT_YUYV, PixelFormat::Yuyv},
    V4l2PixelFormat{V4L2_PIX_FMT_XBGR32, PixelFormat::Bgra8},
    V4l2PixelFormat{V4L2_PIX_FMT_ABGR32, PixelFormat::Bgra8},
    V4l2PixelFormat{V4L2_PIX_FMT_BGR32, PixelFormat::Bgra8},
    V4l2PixelFormat{V4L2_PIX_FMT_MJPEG, PixelFormat::Yuv420, true},
    V4l2PixelFormat{V4L2_PIX_FMT_JPEG, PixelFormat::Yuv420, true},
    V4l2PixelFormat{V4L2_PIX_FMT_GREY, PixelFormat::Gray8},
};

struct Offer {
    std::uint32_t fourcc = 0;
    bool hasSize = false;
    double fastest = 0;
    std::string sizes;
};

double rateOf(const v4l2_fract& interval) {
    return interval.numerator > 0 ? static_cast<double>(interval.denominator) / interval.numerator
                                  : 0;
}

double fastestRate(const V4l2Device& device, std::uint32_t fourcc, Size size) {
    double out = 0;
    for (int i = 0; i < kMostOffers; ++i) {
        v4l2_frmivalenum query{};
        query.index = static_cast<std::uint32_t>(i);
        query.pixel_format = fourcc;
        query.width = static_cast<std::uint32_t>(size.width);
        query.height = static_cast<std::uint32_t>(size.height);
        if (device.tryCall(VIDIOC_ENUM_FRAMEINTERVALS, &query) != 0) break;
        const bool discrete = query.type == V4L2_FRMIVAL_TYPE_DISCRETE;
        out = std::max(out, rateOf(discrete ? query.discrete : query.stepwise.min));
        if (!discrete) break;
    }
    return out;
}

bool contains(const v4l2_frmsize_stepwise& s, Size size) {
    const auto fits = [](std::uint32_t value, std::uint32_t low, std::uint32_t high,
                         std::uint32_t step) {
        return value >= low && value <= high && (step == 0 || (value - low) % step == 0);
    };
    return fits(static_cast<std::uint32_t>(size.width), s.min_width, s.max_width, s.step_width) &&
           fits(static_cast<std::uint32_t>(size.height), s.min_height, s.max_height, s.step_height);
}

// A driver that lists no sizes counts as offering every size; setFormat() then fails for an
// unsupported size.
void askSizes(const V4l2Device& device, Size wanted, Offer& offer) {
    for (int i = 0; i < kMostOffers; ++i) {
        v4l2_frmsizeenum query{};
        query.index = static_cast<std::uint32_t>(i);
        query.pixel_format = offer.fourcc;
        const int error = device.tryCall(VIDIOC_ENUM_FRAMESIZES, &query);
        if (error == ENODEV) device.fail("listing the sizes", error);
        if (error != 0) {
            if (i == 0) {
                offer.hasSize = true;
                offer.sizes = "sizes not listed";
            }
            return;
        }
        if (query.type != V4L2_FRMSIZE_TYPE_DISCRETE) {
            const auto& s = query.stepwise;
            offer.hasSize = contains(s, wanted);
            offer.sizes = fmt::format("{}x{} to {}x{} in steps of {}x{}", s.min_width, s.min_height,
                                      s.max_width, s.max_height, s.step_width, s.step_height);
            return;
        }
        const auto& d = query.discrete;
        if (static_cast<int>(d.width) == wanted.width &&
            static_cast<int>(d.height) == wanted.height)
            offer.hasSize = true;
        offer.sizes += fmt::format("{}{}x{}", i == 0 ? "" : " ", d.width, d.height);
    }
}

struct ListedFormats {
    std::vector<std::uint32_t> fourccs;
    int error = 0;  ///< error number that ended the list; 0: the list was too long
};

ListedFormats formatsOf(const V4l2Device& device) {
    ListedFormats out;
    for (int i = 0; i < kMostOffers; ++i) {
        v4l2_fmtdesc query{};
        query.index = static_cast<std::uint32_t>(i);
        query.type = bufferType(device);
        out.error = device.tryCall(VIDIOC_ENUM_FMT, &query);
        if (out.error != 0) break;
        out.fourccs.push_back(query.pixelformat);
    }
    return out;
}

std::vector<Offer> offersOf(const V4l2Device& device, Size wanted) {
    const ListedFormats formats = formatsOf(device);
    if (formats.error == ENODEV) device.fail("listing the formats", formats.error);
    std::vector<Offer> out;
    for (const std::uint32_t fourcc : formats.fourccs) {
        Offer offer;
        offer.fourcc = fourcc;
        askSizes(device, wanted, offer);
        if (offer.hasSize) offer.fastest = fastestRate(device, offer.fourcc, wanted);
        out.push_back(std::move(offer));
    }
    return out;
}

[[noreturn]] void refuse(const V4l2Device& device, const V4l2Wish& wish,
                         const std::vector<Offer>& offers) {
    std::string all;
    for (const Offer& o : offers)
        all += fmt::format("\n  {}: {}", fourccText(o.fourcc), o.sizes);
    throw std::runtime_error(
        fmt::format("{}: camera '{}' does not offer {}x{} in {}; it offers{}", device.path(),
                    device.card(), wish.size.width, wish.size.height,
                    wish.format.empty() ? "a format that can be used" : wish.format,
                    all.empty() ? " nothing" : all));
}

}  // namespace

std::span<const V4l2PixelFormat> usableFormats() {
    return kUsable;
}

std::string fourccText(std::uint32_t fourcc) {
    std::string out;
    for (int shift = 0; shift < 32; shift += 8) {
        const auto c = static_cast<char>(fourcc >> shift & 0x7f);
        out += c >= ' ' && c < 0x7f ? c : '.';
    }
    return out.substr(0, out.find_last_not_of(' ') + 1);
}

V4l2PixelFormat chooseFormat(const V4l2Device& device, const V4l2Wish& wish) {
    const std::vector<Offer> offers = offersOf(device, wish.size);
    // The tolerance is needed because drivers round frame intervals, some to microseconds.
    const double enough = wish.rateHz * 0.999;
    for (const bool inTime : {true, false})
        for (const V4l2PixelFormat& format : kUsable) {
            if (!wish.format.empty() && wish.format != fourccText(format.fourcc)) continue;
            const auto fits = [&](const Offer& o) {
                return o.fourcc == format.fourcc && o.hasSize &&
                       (!inTime || o.fastest == 0 || o.fastest >= enough);
            };
            if (std::any_of(offers.begin(), offers.end(), fits)) return format;
        }
    refuse(device, wish, offers);
}

bool hasUsableFormat(const V4l2Device& device) {
    return std::ranges::any_of(formatsOf(device).fourccs, [](std::uint32_t fourcc) {
        return std::ranges::find(kUsable, fourcc, &V4l2PixelFormat::fourcc) != std::end(kUsable);
    });
}

std::int64_t largestPicture(const V4l2Device& device) {
    std::int64_t most = 0;
    for (const V4l2PixelFormat& format : kUsable)
        for (int i = 0; i < kMostOffers; ++i) {
            v4l2_frmsizeenum query{};
            query.index = static_cast<std::uint32_t>(i);
            query.pixel_format = format.fourcc;
            if (device.tryCall(VIDIOC_ENUM_FRAMESIZES, &query) != 0) break;
            const bool discrete = query.type == V4L2_FRMSIZE_TYPE_DISCRETE;
            const std::uint32_t width = discrete ? query.discrete.width : query.stepwise.max_width;
            const std::uint32_t height =
                discrete ? query.discrete.height : query.stepwise.max_height;
            most = std::max(most,
                            std::int64_t{std::min(width, kMostSide)} * std::min(height, kMostSide));
            if (!discrete) break;
        }
    return most;
}

double setRate(const V4l2Device& device, double rateHz) {
    v4l2_streamparm parameters{};
    parameters.type = bufferType(device);
    if (device.tryCall(VIDIOC_G_PARM, &parameters) != 0) return 0;
    auto& capture = parameters.parm.capture;
    if (rateHz > 0 && (capture.capability & V4L2_CAP_TIMEPERFRAME) != 0) {
        capture.timeperframe = {1000, static_cast<std::uint32_t>(std::lround(rateHz * 1000))};
        device.call(VIDIOC_S_PARM, &parameters,
                    fmt::format("setting the frame rate to {} Hz", rateHz));
    }
    const double rate = rateOf(capture.timeperframe);
    return rate > 0 && rate < 1e5 ? rate : 0;
}

std::uint32_t bufferType(const V4l2Device& device) {
    return device.multiPlanar() ? V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE : V4L2_BUF_TYPE_VIDEO_CAPTURE;
}

}  // namespace mfar
