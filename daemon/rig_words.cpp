#include "daemon/rig_words.h"

#include "hal/device/display_spec.h"
#include "hal/virtual/synthetic_scene.h"

#include <fmt/format.h>

#include <array>

namespace mfar {
namespace {

using synthetic::Path;

constexpr std::array kScenes = {synthetic::Scene::Office,     synthetic::Scene::Shelf,
                                synthetic::Scene::Outdoor,    synthetic::Scene::Flat,
                                synthetic::Scene::Moving,     synthetic::Scene::Still,
                                synthetic::Scene::Calibration};
constexpr std::array kPaths = {Path::Handheld, Path::Pan,  Path::Orbit, Path::Forward,
                               Path::Rotate,   Path::Rest, Path::Survey};

template <class Kinds>
std::string names(const Kinds& kinds) {
    std::string all;
    for (const auto kind : kinds)
        all.append(all.empty() ? "" : ", ").append(synthetic::name(kind));
    return all;
}

}  // namespace

SourceWords sourceWords(std::string_view source) {
    SourceWords words;
    const std::size_t colon = source.find(':');
    words.kind = source.substr(0, colon);
    if (colon == source.npos) return words;
    const std::string_view rest = source.substr(colon + 1);
    const std::size_t comma = rest.find(',');
    words.scene = rest.substr(0, comma);
    if (comma != rest.npos) words.path = rest.substr(comma + 1);
    return words;
}

bool isScreen(std::string_view display) {
    const std::string_view kind = display.substr(0, display.find_first_of(":,"));
    return kind == "auto" || kind == "kms" || kind == "fbdev";
}

std::optional<std::string> sourceFault(std::string_view source) {
    if (source == kCameras) return std::nullopt;
    const SourceWords words = sourceWords(source);
    if (words.kind != "synthetic")
        return fmt::format("unknown source \"{}\"; expected cameras or synthetic[:scene[,path]]; "
                           "--recording plays recordings",
                           words.kind);
    if (words.scene && !synthetic::sceneNamed(*words.scene))
        return fmt::format("unknown scene \"{}\"; expected one of {}", *words.scene,
                           names(kScenes));
    if (words.path && !synthetic::pathNamed(*words.path))
        return fmt::format("unknown camera path \"{}\"; expected one of {}", *words.path,
                           names(kPaths));
    return std::nullopt;
}

bool keepsPictures(std::string_view display) {
    return display.starts_with("png:") || display.starts_with("y4m:");
}

std::optional<std::string> displayFault(std::string_view display) {
    if (display == "none") return std::nullopt;
    if (isScreen(display)) return screenFault(display);
    for (const std::string_view kind : {"png:", "y4m:"})
        if (display.starts_with(kind) && display.size() > kind.size()) return std::nullopt;
    return fmt::format(
        "unknown display \"{}\"; expected auto, kms, fbdev, none, png:FOLDER or y4m:FILE", display);
}

}  // namespace mfar
