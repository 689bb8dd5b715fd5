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

/// An object from the configuration file.
struct PlacedObject {
    /// The model. Null: the simple shape is used.
    std::shared_ptr<const Model> model;
    std::string modelName;  ///< "showpiece" or a file name, for messages; empty for a shape
    VirtualObject shape;    ///< the shape's T_world_object is ignored
    float scale = 1;        ///< scale of a model, above 0; unused for a shape
    RigidTransform T_anchor_object;
    /// The frame in which the object is placed. Empty: the world of the tag map. If a tag is given,
    /// the origin is the tag's centre; x points to the right and y up in the tag's print, and z
    /// points out of the print.
    std::optional<TagKey> tag;
};

enum class LightSource : unsigned char {
    Studio,  ///< studioEnvironment()
    Sky,     ///< skyEnvironment()
    File,    ///< a latitude-longitude picture
    Camera,  ///< estimated from the video by LightEstimator
};

struct LightOptions {
    LightSource source = LightSource::Studio;
    std::shared_ptr<const Environment> environment;  ///< only for File, else null
    std::string file;                                ///< file name, for messages
    /// A sun in addition to the environment. It replaces the sun that is estimated from the camera.
    std::optional<Sun> sun;
    float exposure = 1;  ///< radiance 1 / exposure is displayed as white; above 0
};

enum class VirtualRendering : unsigned char { PathTraced, Preview };

/// Settings of the virtual layer.
struct VirtualOptions {
    VirtualRendering rendering = VirtualRendering::PathTraced;
    double budgetMs = 8;  ///< path tracing per frame [ms of processor time]
    Slicing slicing = Slicing::Time;
    int samples = 64;          ///< samples of each pixel of a finished picture
    double resolution = 0.28;  ///< width of a path-traced picture relative to the still's
    HoleFilling holes = HoleFilling::Both;
    int threads = 1;     ///< threads of the path tracer
    bool filter = true;  ///< whether the noise of pictures with few samples is smoothed
    /// Upper limit of the angle between the views of two consecutive reference pictures [degrees].
    double turnDeg = 4;

    bool operator==(const VirtualOptions&) const = default;
};

}  // namespace mfar
