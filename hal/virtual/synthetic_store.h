#pragma once

#include "hal/virtual/synthetic_scene.h"

#include <opencv2/core.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>

namespace mfar::synthetic {

/// Keeps the computed textures and light maps of the simulated board in a folder, because computing
/// them takes seconds. Several processes and threads may use the same folder. A file that is
/// missing, broken or not writable only costs the time to compute its texels.
class TexelStore {
public:
    static constexpr int kMostFiles = 64;  // 4 MB each; the files used least recently are removed

    /// An empty path: nothing is kept.
    explicit TexelStore(std::filesystem::path folder);

    /// Returns the square picture that `make` computes. `key` must be a hash of all inputs of
    /// `make`.
    [[nodiscard]] cv::Mat4b get(std::uint64_t key, int side,
                                const std::function<cv::Mat4b()>& make) const;

    /// Returns the folder that all programs of this user share, e.g. ~/.cache/mfar/synthetic, or an
    /// empty path if there is no home.
    [[nodiscard]] static std::filesystem::path userFolder();

private:
    std::filesystem::path folder_;
};

/// lightKey() returns a hash of all properties of the world that its light map depends on;
/// layerKey() returns a hash of a texture layer and its seed. Both hashes also depend on the
/// sources and libraries that compute the texels.
[[nodiscard]] std::uint64_t lightKey(const World& world);
[[nodiscard]] std::uint64_t layerKey(Layer layer, std::uint64_t seed);

}  // namespace mfar::synthetic
