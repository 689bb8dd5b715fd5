#pragma once

#include "pipeline/composite/virtual_object.h"
#include "pipeline/scene/scene.h"
#include "pipeline/slices/slices.h"
#include "pipeline/track/tag_family.h"
#include "pipeline/warp/warp_options.h"

#include <memory>
#include <optional>
#include <string>

namespace mfar {

template <class T>
[[nodiscard]] bool sameContent(const std::shared_ptr<const T>& a,
                               const std::shared_ptr<const T>& b) {
    return a == b || (a != nullptr && b != nullptr && *a == *b);
}

/// An object from the configuration file. It shows `model`, or `shape` if `model` is null. The
/// member T_world_object of `shape` is not used.
struct PlacedObject {
    std::shared_ptr<const Model> model;
    std::string modelName;  ///< "showpiece" or a file name, for messages; empty without a model
    VirtualObject shape;
    float scale = 1;  ///< scale of the model, above 0; not used for `shape`
    RigidTransform T_anchor_object;
    /// The tag to which T_anchor_object refers: its frame has the origin in the tag's centre, x
    /// right and y up in the tag's print, and z out of the print. If not set, T_anchor_object
    /// refers to the world of the tag map.
    std::optional<TagKey> tag;

    /// Compares the contents of the models.
    friend bool operator==(const PlacedObject& a, const PlacedObject& b) {
        return sameContent(a.model, b.model) && a.shape == b.shape && a.scale == b.scale &&
               a.T_anchor_object == b.T_anchor_object && a.tag == b.tag;
    }
};

enum class LightSource : unsigned char {
    Studio,
    Sky,
    File,
    Camera,  ///< estimated from the video by LightEstimator
};

struct LightOptions {
    LightSource source = LightSource::Studio;
    std::shared_ptr<const Environment> environment;
    std::string file;
    /// A sun in addition to the environment. With LightSource::Camera, it replaces the estimated
    /// sun.
    std::optional<Sun> sun;
    float exposure = 1;  ///< a radiance of 1 / exposure is displayed as white; above 0

    /// Compares the contents of the environments.
    friend bool operator==(const LightOptions& a, const LightOptions& b) {
        return a.source == b.source && sameContent(a.environment, b.environment) &&
               a.sun == b.sun && a.exposure == b.exposure;
    }
};

enum class VirtualRendering : unsigned char { PathTraced, Preview };

struct VirtualOptions {
    VirtualRendering rendering = VirtualRendering::PathTraced;
    /// Processor time for path tracing in each frame [ms]; twice this until the first picture is
    /// shown.
    double budgetMs = 8;
    Slicing slicing = Slicing::Time;
    int samples = 64;
    /// Width and height of a traced picture as a share of Pipeline::fullSize(). The picture is
    /// never larger than the output.
    double resolution = 0.28;
    HoleFilling holes = HoleFilling::Both;
    int threads = 1;
    bool filter = true;
    /// A new traced picture is begun at the latest when the direction from an object to the camera
    /// has turned by this angle [degrees].
    double turnDeg = 4;

    bool operator==(const VirtualOptions&) const = default;
};

}  // namespace mfar
