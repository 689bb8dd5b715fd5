#pragma once

#include "hal/virtual/image_files.h"
#include "pipeline/render/path_tracer.h"

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace mfar::eval {

/// True pictures, path-traced for the view of each frame. A folder keeps them for later runs of the
/// program.
class TracedTruth {
public:
    /// `name`: name of scene and path, for file names. Different scenes need different names, also
    /// different versions of a scene, see sceneKey().
    /// If `folder` is empty, no files are kept.
    TracedTruth(const std::shared_ptr<const Scene>& scene, int samples,
                std::filesystem::path folder, const std::string& name);

    /// The picture stays valid as long as this object exists. Incomplete files are traced again.
    /// Throws EvalError if a file cannot be written.
    const RenderedPicture& at(int frame, const RenderView& view, Timestamp time);

private:
    [[nodiscard]] std::filesystem::path fileOf(int frame, Size size) const;

    std::shared_ptr<const Scene> scene_;
    PathTracer tracer_;
    int samples_;
    std::filesystem::path folder_;
    std::string stem_;
    std::map<int, RenderedPicture> pictures_;
};

[[nodiscard]] StoredImage
rgbaOf(const std::vector<const std::vector<std::array<float, 3>>*>& pictures, Size size);

}  // namespace mfar::eval
