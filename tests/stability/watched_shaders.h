#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

/// Versions of the project's shaders that replace those of gles_shaders in this program. Each index
/// into a storage buffer, a texture or an image is compared with its bounds. An invalid index is
/// counted and clamped. A fault may be planted in one of the shaders.
namespace mfar::stress {

inline constexpr unsigned kWatchBinding = 15;  ///< binding of the counters
inline constexpr std::size_t kMostWatched = 128;

/// Name of the shader whose invalid indices are counted in element `index` of the buffer
/// kWatchBinding.
[[nodiscard]] std::string watchedName(std::size_t index);

/// Returns the shader `text` with checks of its indices. Invalid indices are counted in element
/// `index` of the buffer kWatchBinding.
[[nodiscard]] std::string watched(std::string_view text, std::size_t index);

struct PlantedFault {
    const char* shader;
    const char* from;  ///< text to be replaced in the shader that the program loads
    const char* to;
    const char* what;
    const char* cases;  ///< names of cases that must detect this fault, separated by commas
};
[[nodiscard]] std::span<const PlantedFault> plantedFaults();
/// Throws std::runtime_error if the shader does not contain `from` exactly once.
void requirePlantable(const PlantedFault& fault);
/// Must be called before the first shader is loaded. Throws as requirePlantable() does.
void plant(const PlantedFault& fault);

}  // namespace mfar::stress
