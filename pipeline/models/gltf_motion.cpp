#include "pipeline/models/gltf_motion.h"

#include "pipeline/models/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace mfar {
namespace {

constexpr double kLeastQuaternion = 1e-6;
constexpr float kLongest = 1e6F;   // upper limit of the times of an animation [s]
constexpr float kFarthest = 1e6F;  // upper limit of translations [m] and of their tangents [m/s]

/// Returns a sentence for each kind of motion that is never played: further animations, skins,
/// morph targets. The sentence states where the document first has this kind of motion.
std::vector<std::string> stillParts(const GltfDocument& document) {
    std::vector<std::string> out;
    const tinygltf::Model& gltf = document.gltf;
    if (gltf.animations.size() > 1)
        out.push_back(document.sentence("animations[1]", "only the first animation is played"));
    if (!gltf.skins.empty())
        out.push_back(document.sentence(
            "skins[0]", "skins are not applied; the mesh is shown as if it had no skeleton"));
    for (std::size_t mesh = 0; mesh < gltf.meshes.size(); ++mesh) {
        const auto& parts = gltf.meshes[mesh].primitives;
        const auto morphed =
            std::ranges::find_if(parts, [](const auto& part) { return !part.targets.empty(); });
        if (morphed == parts.end()) continue;
        out.push_back(document.sentence(
            fmt::format("meshes[{}].primitives[{}].targets", mesh, morphed - parts.begin()),
            "morph targets are not applied; the mesh is shown without them"));
        break;
    }
    return out;
}

}  // namespace

GltfMotion::GltfMotion(const GltfDocument& document)
    : document_(document), notes_(stillParts(document)) {
    if (document.gltf.animations.empty()) return;
    const tinygltf::Animation& animation = document.gltf.animations.front();
    for (std::size_t i = 0; i < animation.channels.size(); ++i)
        readChannel(animation, i);
}

const GltfMotion::Tracks* GltfMotion::of(int node) const {
    const auto found = tracks_.find(node);
    return found == tracks_.end() ? nullptr : &found->second;
}

void GltfMotion::readChannel(const tinygltf::Animation& animation, std::size_t channel) {
    const std::string place = fmt::format("animations[0].channels[{}]", channel);
    const tinygltf::AnimationChannel& from = animation.channels[channel];
    if (from.target_node < 0) return;  // the target belongs to an unknown extension
    const bool turns = from.target_path == "rotation";
    if (!turns && from.target_path != "translation") {
        note(place, from.target_path == "scale" ? "changes of the scale are not played"
                                                : "only translations and rotations are played");
        return;
    }
    const tinygltf::Node& node = document_.at(document_.gltf.nodes, from.target_node, place);
    if (!node.matrix.empty()) document_.refuse(place, "a node with a matrix cannot move");
    MotionTrack track =
        keyframesOf(document_.at(animation.samplers, from.sampler, place), turns, place);
    count(track, place);
    length_ = std::max(length_, track.times.back());
    Tracks& tracks = tracks_[from.target_node];
    (turns ? tracks.rotation : tracks.translation) = std::move(track);
}

void GltfMotion::count(const MotionTrack& track, const std::string& place) {
    const std::size_t most = document_.limits.keyframes;
    if (track.times.size() > most - keyframes_)
        document_.refuse(place, fmt::format("the animations have more than {} keyframes", most));
    keyframes_ += track.times.size();
}

std::vector<double> GltfMotion::timesOf(int accessor, const std::string& place) const {
    const std::vector<float> times =
        accessorFloats(document_, accessor, 1, document_.limits.elements, place);
    if (times.front() < 0 ||
        std::ranges::adjacent_find(times, std::greater_equal<>()) != times.end())
        document_.refuse(place, "the times must not be negative and must increase");
    if (times.back() > kLongest) document_.refuse(place, "the times must be at most 1e6 seconds");
    return {times.begin(), times.end()};
}

MotionTrack GltfMotion::keyframesOf(const tinygltf::AnimationSampler& sampler, bool turns,
                                    const std::string& place) const {
    using enum MotionTrack::Between;
    MotionTrack out;
    out.between = sampler.interpolation == "STEP"          ? Step
                  : sampler.interpolation == "CUBICSPLINE" ? CubicSpline
                                                           : Linear;
    out.times = timesOf(sampler.input, place);
    const std::size_t ofTime = out.between == CubicSpline ? 3 : 1;
    const int components = turns ? 4 : 3;
    const std::size_t count = out.times.size() * ofTime;
    const std::vector<float> values =
        accessorFloats(document_, sampler.output, components, count, place);
    if (values.size() != count * static_cast<std::size_t>(components))
        document_.refuse(
            place, fmt::format("the sampler must have {} values, {} for each time", count, ofTime));
    if (std::ranges::any_of(values, [](float v) { return std::abs(v) > kFarthest; }))
        document_.refuse(place, "the values must be between -1e6 and 1e6");
    for (std::size_t i = 0; i < count; ++i) {
        const float* v = &values[i * static_cast<std::size_t>(components)];
        Eigen::Vector4d value(v[0], v[1], v[2], turns ? v[3] : 0);
        if (turns && (ofTime == 1 || i % 3 == 1)) {
            if (!(value.norm() > kLeastQuaternion))
                document_.refuse(place, "a rotation is a quaternion of length 0");
            value.normalize();
        }
        out.values.push_back(value);
    }
    return out;
}

void GltfMotion::note(const std::string& place, const char* what) {
    const auto isKnown = [&](const std::string& known) { return known.ends_with(what); };
    if (std::ranges::none_of(notes_, isKnown)) notes_.push_back(document_.sentence(place, what));
}

}  // namespace mfar
