#pragma once

#include "pipeline/engine/engine.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mfar {

class TomlReader;

/// Which engine a step is configured to run on.
enum class EngineWish : std::uint8_t {
    Auto,  ///< mfard decides
    Gles,
    Simd
};
[[nodiscard]] std::optional<EngineWish> engineWish(std::string_view word);

/// Section [engine] of the configuration.
struct EngineConfig {
    EngineWish use = EngineWish::Auto;  ///< for every step that is not set below
    EngineWish still = EngineWish::Auto, pyramid = EngineWish::Auto, flow = EngineWish::Auto,
               weigh = EngineWish::Auto, detail = EngineWish::Auto, occlusion = EngineWish::Auto;

    /// True when every step is set to SIMD, so that GLES is not needed.
    [[nodiscard]] bool isSimdAlone() const;
    /// True when a step is set to GLES, so that GLES is required.
    [[nodiscard]] bool needsGles() const;
    bool operator==(const EngineConfig&) const = default;
};

/// Reads section [engine].
void readEngine(TomlReader& file, EngineConfig& engine);

/// `decided`, with the configured steps replaced.
[[nodiscard]] EngineChoice withWishes(const EngineConfig& engine, EngineChoice decided);

/// "simd" where all steps run there, else every step: "still gles, flow simd, ...".
[[nodiscard]] std::string describe(const EngineChoice& choice);
/// The inverse of describe(); nothing for any other text.
[[nodiscard]] std::optional<EngineChoice> parseEngineChoice(std::string_view text);

}  // namespace mfar
