#include "tests/measure/eval/traced_truth.h"

#include "pipeline/scene/scene_parts.h"
#include "tests/measure/eval/report.h"
#include "tests/measure/eval/warp_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace mfar::eval {
namespace {

template <class T>
void transfer(std::istream& in, std::vector<T>& values) {
    in.read(reinterpret_cast<char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(T)));
}
template <class T>
void transfer(std::ostream& out, std::vector<T>& values) {
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(T)));
}
template <class Stream>
void transferAll(Stream& stream, RenderedPicture& picture) {
    transfer(stream, picture.colour);
    transfer(stream, picture.depth);
    transfer(stream, picture.id);
}

}  // namespace

TracedTruth::TracedTruth(const std::shared_ptr<const Scene>& scene, int samples,
                         std::filesystem::path folder, const std::string& name)
    : scene_(scene), tracer_(scene, tracerOptions(true)), samples_(samples),
      folder_(std::move(folder)), stem_(name) {
    if (!folder_.empty()) std::filesystem::create_directories(folder_);
}

std::filesystem::path TracedTruth::fileOf(int frame, Size size) const {
    return folder_ /
           fmt::format("{}-{}x{}-{}-{:03}.truth", stem_, size.width, size.height, samples_, frame);
}

const RenderedPicture& TracedTruth::at(int frame, const RenderView& view, Timestamp time) {
    if (const auto known = pictures_.find(frame); known != pictures_.end()) return known->second;
    RenderedPicture& picture = pictures_[frame];
    const Size size = view.camera.size;
    if (!folder_.empty()) {
        const auto pixels = static_cast<std::size_t>(size.width) * size.height;
        picture.camera = view.camera;
        picture.T_world_camera = view.T_world_camera;
        picture.colour.resize(pixels);
        picture.depth.resize(pixels);
        picture.id.resize(pixels);
        std::ifstream in(fileOf(frame, size), std::ios::binary);
        if (in) transferAll(in, picture);
        if (in) return picture;
    }
    if (moves(*scene_)) {
        const auto posed = tracer_.posed(std::make_shared<const Scene>(sceneAt(*scene_, time)));
        picture = tracePicture(*posed, view, samples_);
    } else {
        picture = tracePicture(tracer_, view, samples_);
    }
    if (folder_.empty()) return picture;
    std::ofstream out(fileOf(frame, size), std::ios::binary);
    transferAll(out, picture);
    if (!out.flush())
        throw EvalError(fmt::format("{}: cannot be written", fileOf(frame, size).string()));
    return picture;
}

StoredImage rgbaOf(const std::vector<const std::vector<std::array<float, 3>>*>& pictures,
                   Size size) {
    const int count = static_cast<int>(pictures.size());
    StoredImage out{{size.width * count, size.height}, PixelFormat::Rgba8, {}};
    for (int y = 0; y < size.height; ++y)
        for (const auto* picture : pictures)
            for (int x = 0; x < size.width; ++x) {
                const auto& rgb = (*picture)[static_cast<std::size_t>(y) * size.width + x];
                for (const float v : rgb)
                    out.pixels.push_back(
                        static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.0F, 255.0F))));
                out.pixels.push_back(255);
            }
    return out;
}

}  // namespace mfar::eval
