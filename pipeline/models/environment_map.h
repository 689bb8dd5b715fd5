#pragma once

#include "pipeline/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

namespace mfar {

/// Most memory that reading an environment may take [bytes]. The file itself may take half of it.
inline constexpr std::size_t kEnvironmentMemory = std::size_t{1} << 30U;

/// Reads an environment from a latitude-longitude picture: Radiance RGBE (.hdr), PNG or JPEG (sRGB;
/// white has radiance 1). The picture must be twice as wide as high (to within 1 % or 1 px), and at
/// most 16384 px wide (PNG and JPEG: 8192 px). A larger picture than 2048x1024 is reduced to this
/// size by averaging. Throws ModelError with the message "file: fault".
[[nodiscard]] Environment loadEnvironment(const std::filesystem::path& file,
                                          std::size_t memory = kEnvironmentMemory);
/// Reads an environment from the bytes of a file. `name` is its name in error messages.
[[nodiscard]] Environment parseEnvironment(std::span<const std::uint8_t> bytes,
                                           const std::string& name,
                                           std::size_t memory = kEnvironmentMemory);

/// A photographer's studio: a dim room with a large soft box at the upper left in front (-x, -y), a
/// strip light on the right, and a strip light of cold colour behind. A white surface that faces up
/// has a radiance near 1.
[[nodiscard]] Environment studioEnvironment();

/// A clear sky without the sun's disc, over grey ground. `towardsSun` is a unit vector above the
/// horizon. A white surface that faces up has a radiance near 1. Source: CIE S 011/E:2003, sky type
/// 12.
[[nodiscard]] Environment skyEnvironment(const Eigen::Vector3f& towardsSun);

/// Returns the direction in the world of a point (u, v) in [0, 1]^2 of an Environment.
[[nodiscard]] Eigen::Vector3f environmentDirection(float u, float v);
/// Returns an environment of `size` texels. For each texel, `radiance` is called with the direction
/// of the texel's centre in the world and returns the texel's value.
[[nodiscard]] Environment
environmentOf(Size size, const std::function<Eigen::Vector3f(const Eigen::Vector3f&)>& radiance);

}  // namespace mfar
