#pragma once

#include "daemon/objects_config.h"
#include "pipeline/pipeline.h"
#include "pipeline/scene/virtual_options.h"

#include <string_view>
#include <vector>

namespace mfar {

/// The virtual objects, their light and the real surface below them, as given to the pipeline.
/// Lives on the GL thread.
class VirtualWorld {
public:
    VirtualWorld(const VirtualOptions& options, const StereoRig& rig, Pipeline& pipeline);

    /// Shows these objects, placed by the tag map, without those that leftOut() names.
    void set(const std::vector<PlacedObject>& objects, const LightOptions& light,
             const TagMap& tags);
    /// True when `options` show previews, which are drawn with OpenGL ES, whichever engine executes
    /// the steps.
    [[nodiscard]] static bool drawsPreviews(const VirtualOptions& options);
    /// Why models are not shown; empty when they are shown.
    [[nodiscard]] std::string_view shapesAlone() const;

private:
    [[nodiscard]] TracedLayerOptions layerOptions() const;

    VirtualOptions options_;
    Size fullSize_;  // of the still's resolution
    Pipeline& pipeline_;
    bool traced_;
    float exposure_ = 1;
};

/// Options of the traced layer except its size, which the caller sets.
[[nodiscard]] TracedLayerOptions tracedLayerOptions(const VirtualOptions& options, float exposure);

/// A scene of these objects, placed by the tag map, in this light. Light estimated from the camera
/// begins as a dim studio's.
[[nodiscard]] Scene sceneOf(const std::vector<PlacedObject>& objects, const LightOptions& light,
                            const TagMap& tags);

}  // namespace mfar
