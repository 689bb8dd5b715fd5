#pragma once

#include "pipeline/models/gltf_document.h"
#include "pipeline/scene/rigid_path.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace mfar {

/// The motion of a document's nodes: translations and rotations of its first animation. Other
/// motion is not played, and notes() contains a sentence about each kind of it. Invalid keyframes
/// are refused.
class GltfMotion {
public:
    explicit GltfMotion(const GltfDocument& document);

    struct Tracks {
        MotionTrack translation, rotation;
    };
    /// Returns the tracks of the node with this index, or null if the animation has none for it. A
    /// track of the result may be constant or empty.
    [[nodiscard]] const Tracks* of(int node) const;
    [[nodiscard]] double length() const { return length_; }  ///< length of the animation [s]

    /// Adds to the number of keyframes that the model stores. Refuses the document if there are
    /// more than its limits allow. `place` is named in the message.
    void count(const MotionTrack& track, const std::string& place);

    /// Adds a sentence about something that is not shown, unless notes() has one with the same
    /// `what`.
    void note(const std::string& place, const char* what);
    [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

private:
    void readChannel(const tinygltf::Animation& animation, std::size_t channel);
    MotionTrack keyframesOf(const tinygltf::AnimationSampler& sampler, bool turns,
                            const std::string& place) const;
    [[nodiscard]] std::vector<double> timesOf(int accessor, const std::string& place) const;

    const GltfDocument& document_;
    std::size_t keyframes_ = 0;
    std::map<int, Tracks> tracks_;
    double length_ = 0;
    std::vector<std::string> notes_;
};

}  // namespace mfar
