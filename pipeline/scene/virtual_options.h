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

/// An object from the configuration.
struct PlacedObject {
    /// The model. Null: use the simple shape.
    std::shared_ptr<const Model> model;
    std::string modelName;  ///< "showpiece" or a file, for messages; empty for a shape
    VirtualObject shape;    ///< its T_world_object is ignored
    float scale = 1;        ///< of a model only, above 0
    RigidTransform T_anchor_object;
    /// The frame it is placed in. Empty: the tag map's world. A tag: origin in the tag's centre, x
    /// to the right and y up in its print, z out of it.
    std::optional<TagKey> tag;
};

enum class LightSource : unsigned char {
    Studio,  ///< studioEnvironment()
    Sky,     ///< skyEnvironment()
    File,    ///< a latitude-longitude picture
    Camera,  ///< estimated from the video, LightEstimator
};

struct LightOptions {
    LightSource source = LightSource::Studio;
    std::shared_ptr<const Environment> environment;  ///< for File; null for other sources
    std::string file;                                ///< for messages
    /// Light in addition to the environment; replaces the camera's own estimate of a sun.
    std::optional<Sun> sun;
    float exposure = 1;  ///< white has radiance 1 / exposure; above 0
};

enum class VirtualRendering : unsigned char { PathTraced, Preview };

/// Settings of the virtual layer.
struct VirtualOptions {
    VirtualRendering rendering = VirtualRendering::PathTraced;
    double budgetMs = 8;  ///< path tracing time per frame [ms]
    Slicing slicing = Slicing::Time;
    int samples = 64;          ///< samples per pixel of a finished picture
    double resolution = 0.28;  ///< side of a path-traced picture as a fraction of the still's
    HoleFilling holes = HoleFilling::Both;
    int threads = 1;     ///< threads of the path tracer
    bool filter = true;  ///< smooths the noise of pictures with few samples
    /// [degrees]: upper limit of the view angle between two reference pictures.
    double turnDeg = 4;

    bool operator==(const VirtualOptions&) const = default;
};

}  // namespace mfar
