#pragma once

#include "daemon/objects_config.h"
#include "pipeline/pipeline.h"
#include "pipeline/scene/virtual_options.h"

#include <string_view>
#include <vector>

namespace mfar {

/// Passes the virtual objects and their light to the pipeline. Only the picture thread may use it.
class VirtualWorld {
public:
    VirtualWorld(const VirtualOptions& options, const StereoRig& rig, Pipeline& pipeline);

    /// Shows these objects, except those that leftOut() lists. `tags` gives the poses of the tags
    /// on which objects stand.
    void set(const std::vector<PlacedObject>& objects, const LightOptions& light,
             const TagMap& tags);
    /// Returns true if previews of virtual objects are shown. They are drawn with OpenGL ES, even
    /// if all steps run on SIMD.
    [[nodiscard]] static bool drawsPreviews(const VirtualOptions& options);
    /// Returns the reason why only simple shapes and no models are shown; empty: models are shown.
    [[nodiscard]] std::string_view shapesAlone() const;

private:
    [[nodiscard]] TracedLayerOptions layerOptions() const;

    VirtualOptions options_;
    Size fullSize_;
    Pipeline& pipeline_;
    bool traced_;
    float exposure_ = 1;
};

/// Returns the options of the layer of path-traced objects, all but TracedLayerOptions::size, which
/// layerSize() returns.
[[nodiscard]] TracedLayerOptions tracedLayerOptions(const VirtualOptions& options, float exposure);

/// Returns the size of the path-traced pictures. `full`: Pipeline::fullSize(). `output`: size of
/// the pictures that mfard shows.
[[nodiscard]] Size layerSize(const VirtualOptions& options, Size full, Size output);

/// Returns a scene with these objects in this light. `tags` gives the poses of the tags on which
/// objects stand; objects on other tags are left out. If the light is to be estimated from the
/// camera's pictures, the scene begins with the light of a studio.
[[nodiscard]] Scene sceneOf(const std::vector<PlacedObject>& objects, const LightOptions& light,
                            const TagMap& tags);

}  // namespace mfar
