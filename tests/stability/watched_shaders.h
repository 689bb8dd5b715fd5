#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

/// Versions of the project's shaders, used by this program instead of those of gles_shaders: each
/// index into a storage buffer, a texture or an image is compared with its bounds, counted when out
/// of range, and clamped. A fault may be planted in one of them.
namespace mfar::stress {

inline constexpr unsigned kWatchBinding = 15;  ///< binding of the buffer of uint counts, by shader
inline constexpr std::size_t kMostWatched = 128;  ///< maximum number of shaders

/// The shader of a count.
[[nodiscard]] std::string watchedName(std::size_t index);

/// `text` with its indices checked; violations are counted in element `index`.
[[nodiscard]] std::string watched(std::string_view text, std::size_t index);

/// A change of a shader that the suite has to detect.
struct PlantedFault {
    const char* shader;
    const char* from;  ///< text to replace, as the program gets it
    const char* to;
    const char* what;
    const char* cases;  ///< cases that detect it, separated by commas
};
[[nodiscard]] std::span<const PlantedFault> plantedFaults();
/// To be called before the first shader is loaded. Throws std::runtime_error unless the text
/// contains `from` exactly once.
void plant(const PlantedFault& fault);

}  // namespace mfar::stress
