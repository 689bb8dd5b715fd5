#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

/// The project's shaders as this program gets them instead of those of gles_shaders: each index
/// into a storage buffer, a texture or an image is compared with its bounds, counted when it is out
/// of them, and held at them. One of them may have a fault planted.
namespace mfar::stress {

inline constexpr unsigned kWatchBinding = 15;     ///< buffer of uint counts, by shader
inline constexpr std::size_t kMostWatched = 128;  ///< shaders

/// The shader of a count.
[[nodiscard]] std::string watchedName(std::size_t index);

/// `text` with its indices watched, counted in element `index`.
[[nodiscard]] std::string watched(std::string_view text, std::size_t index);

/// A change of a shader that the suite has to find.
struct PlantedFault {
    const char* shader;
    const char* from;  ///< of its text, as the program gets it
    const char* to;
    const char* what;
    const char* cases;  ///< that find it, separated by commas
};
[[nodiscard]] std::span<const PlantedFault> plantedFaults();
/// Before the first shader is asked for. Throws std::runtime_error when the text does not contain
/// it exactly once.
void plant(const PlantedFault& fault);

}  // namespace mfar::stress
