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
    EngineWish use = EngineWish::Auto;  ///< for every step that is not named below
    EngineWish still = EngineWish::Auto, pyramid = EngineWish::Auto, flow = EngineWish::Auto,
               weigh = EngineWish::Auto, detail = EngineWish::Auto, occlusion = EngineWish::Auto;

    /// Is every step fixed to the host's SIMD lanes, so that GLES is not needed?
    [[nodiscard]] bool isSimdAlone() const;
    /// Is any step fixed to GLES, so that mfard cannot do without?
    [[nodiscard]] bool needsGles() const;
    bool operator==(const EngineConfig&) const = default;
};

/// Reads section [engine].
void readEngine(TomlReader& file, EngineConfig& engine);

/// The choice with the configuration's wishes in place of `decided`.
[[nodiscard]] EngineChoice withWishes(const EngineConfig& engine, EngineChoice decided);

/// "simd" where all steps run there, else each step: "still gles, flow simd, ...".
[[nodiscard]] std::string describe(const EngineChoice& choice);
/// The choice that describe() gave this text for; nothing for another text.
[[nodiscard]] std::optional<EngineChoice> parseEngineChoice(std::string_view text);

}  // namespace mfar
