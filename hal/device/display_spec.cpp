#include "hal/device/display_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace mfar {
namespace {

constexpr double kMaxRateHz = 1000;

template <class T>
std::optional<T> number(std::string_view text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

bool isDigits(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

std::optional<ModeWish> parseMode(std::string_view word) {
    const std::size_t at = word.find('@');
    const std::string_view size = word.substr(0, at);
    const std::size_t cross = size.find('x');
    if (cross == size.npos) return std::nullopt;
    const auto width = number<int>(size.substr(0, cross));
    const auto height = number<int>(size.substr(cross + 1));
    if (!width || !height || *width < 1 || *height < 1 || *width > kMaxScreenSide ||
        *height > kMaxScreenSide)
        return std::nullopt;
    ModeWish wish{{*width, *height}, std::nullopt};
    if (at == word.npos) return wish;
    wish.rateHz = number<double>(word.substr(at + 1));
    if (!wish.rateHz || !(*wish.rateHz >= 1 && *wish.rateHz <= kMaxRateHz)) return std::nullopt;
    return wish;
}

// A connector's name consists of a type and a number: "HDMI-A-1", "Virtual-1".
bool isConnector(std::string_view word) {
    const std::size_t dash = word.rfind('-');
    const auto nameChar = [](char c) {
        return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ||
               c == '-';
    };
    return dash != word.npos && dash > 0 && std::ranges::all_of(word, nameChar) &&
           !(word[0] >= '0' && word[0] <= '9') && isDigits(word.substr(dash + 1));
}

void takeKmsWord(ScreenSpec& spec, std::string_view word) {
    if (spec.device.empty() && word.starts_with("card") && isDigits(word.substr(4))) {
        spec.device = "/dev/dri/" + std::string(word);
    } else if (spec.connector.empty() && isConnector(word)) {
        spec.connector = word;
    } else if (const auto mode = parseMode(word); mode && !spec.mode) {
        spec.mode = mode;
    } else {
        throw std::runtime_error(
            fmt::format("kms: \"{}\" must be a card (like card0), a connector (like HDMI-A-1) or a "
                        "mode (like 1280x720@60), each at most once",
                        word));
    }
}

ScreenSpec parseKms(std::string_view options) {
    ScreenSpec spec{ScreenSpec::Kind::Kms, {}, {}, {}};
    while (!options.empty()) {
        options.remove_prefix(1);
        const std::size_t end = std::min(options.find(','), options.size());
        takeKmsWord(spec, options.substr(0, end));
        options.remove_prefix(end);
    }
    return spec;
}

ScreenSpec parseFbdev(std::string_view options) {
    ScreenSpec spec{ScreenSpec::Kind::Fbdev, {}, {}, {}};
    if (options.empty()) return spec;
    options.remove_prefix(1);
    constexpr std::string_view kFolder = "/dev/fb";
    if (!options.starts_with(kFolder) || !isDigits(options.substr(kFolder.size())))
        throw std::runtime_error(
            fmt::format("fbdev: \"{}\" is not a framebuffer device like /dev/fb0", options));
    spec.device = options;
    return spec;
}

}  // namespace

ScreenSpec parseScreenSpec(std::string_view spec) {
    const std::size_t end = std::min(spec.find_first_of(":,"), spec.size());
    const std::string_view kind = spec.substr(0, end), options = spec.substr(end);
    if (kind == "auto" && options.empty()) return {};
    if (kind == "kms") return parseKms(options);
    if (kind == "fbdev" && !options.starts_with(',')) return parseFbdev(options);
    throw std::runtime_error(fmt::format("unknown screen \"{}\"; expected auto, "
                                         "kms[:cardN][,CONNECTOR][,WxH[@Hz]] or fbdev[:/dev/fbN]",
                                         spec));
}

std::optional<std::string> screenFault(std::string_view spec) {
    try {
        (void)parseScreenSpec(spec);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return std::nullopt;
}

ScreenRect letterbox(Size picture, Size screen) {
    const double scale = std::min(static_cast<double>(screen.width) / picture.width,
                                  static_cast<double>(screen.height) / picture.height);
    const auto side = [scale](int length, int limit) {
        return std::clamp(static_cast<int>(std::lround(length * scale)), 1, limit);
    };
    const Size size{side(picture.width, screen.width), side(picture.height, screen.height)};
    return {(screen.width - size.width) / 2, (screen.height - size.height) / 2, size};
}

}  // namespace mfar
