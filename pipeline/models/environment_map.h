#pragma once

#include "pipeline/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

namespace mfar {

/// Memory limit for reading an environment [byte]; half of it is for the file.
inline constexpr std::size_t kEnvironmentMemory = std::size_t{1} << 30U;

/// Reads a latitude-longitude picture: Radiance RGBE (.hdr), PNG or JPEG (sRGB, white is radiance
/// 1). Its width must be twice its height, to 1 %, and at most 16384 (PNG, JPEG: 8192); more than
/// 2048x1024 pixels are averaged down to this size. Throws ModelError "file: fault".
[[nodiscard]] Environment loadEnvironment(const std::filesystem::path& file,
                                          std::size_t memory = kEnvironmentMemory);
/// As loadEnvironment(), for a file's bytes. `name` is for messages.
[[nodiscard]] Environment parseEnvironment(std::span<const std::uint8_t> bytes,
                                           const std::string& name,
                                           std::size_t memory = kEnvironmentMemory);

/// A photographer's studio: a dim room with a large soft box at the upper left in front (-x, -y), a
/// strip light on the right and a cold one behind. A white surface that faces up has radiance near
/// 1.
[[nodiscard]] Environment studioEnvironment();

/// Clear sky, without its sun, over grey ground. `towardsSun` is a unit vector above the horizon.
/// A white surface that faces up has radiance near 1. Source: CIE S 011/E:2003, sky type 12.
[[nodiscard]] Environment skyEnvironment(const Eigen::Vector3f& towardsSun);

/// World direction of a point in an environment, u and v in [0, 1]; see Environment.
[[nodiscard]] Eigen::Vector3f environmentDirection(float u, float v);
/// An environment of this size, from a function that gives the radiance at each pixel's centre.
[[nodiscard]] Environment
environmentOf(Size size, const std::function<Eigen::Vector3f(const Eigen::Vector3f&)>& radiance);

}  // namespace mfar
