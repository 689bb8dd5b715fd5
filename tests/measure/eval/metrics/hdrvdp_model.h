#pragma once

#include <array>
#include <vector>

/// Model of the human eye in HDR-VDP-2 (Mantiuk, Kim, Rempel, Heidrich 2011, sections 3 and 4),
/// with the constants of releases 2.2.x. Luminances are in cd/m^2, frequencies in cycles/degree.
namespace mfar::eval::hdrvdp {

[[nodiscard]] double opticsGain(double frequency);

[[nodiscard]] double jointSensitivity(double luminance);
[[nodiscard]] double rodSensitivity(double luminance);

/// Contrast sensitivity without optics and receptors; 0 at frequency 0.
[[nodiscard]] double neuralSensitivity(double frequency, double luminance);

/// Shares of a colour channel's light that excite L cones, M cones and rods.
struct ReceptorWeights {
    double l = 0, m = 0, rod = 0;
};
/// Weights of grey, with the white point D65.
inline constexpr ReceptorWeights kGreyWeights{0.601847152244699, 0.316708295579169,
                                              0.904670654599503};
/// Light source of a colour display: LCD with fluorescent lamps, LCD with LEDs, cathode ray tube.
enum class Emission { FluorescentLcd, LedLcd, Crt };
[[nodiscard]] const std::array<ReceptorWeights, 3>& rgbWeights(Emission emission);

/// Parameters of masking: the exponents of signal and mask, and the weights of three masks. `self`
/// is for the mask of the same orientation, `orientations` for that of the band's other
/// orientations, and `neighbours` for that of the adjacent bands.
struct Masking {
    double signalExponent, maskExponent;
    double self, orientations, neighbours;
};
[[nodiscard]] const Masking& masking();

class ReceptorResponse {
public:
    ReceptorResponse();
    /// Responses of an L or M cone, and of a rod. Luminances are clamped to [1e-5, 1e5].
    [[nodiscard]] double cone(double luminance) const { return at(cone_, luminance); }
    [[nodiscard]] double rod(double luminance) const { return at(rod_, luminance); }

    /// Tables for 2048 luminances with evenly spaced logarithms.
    [[nodiscard]] const std::vector<double>& coneTable() const { return cone_; }
    [[nodiscard]] const std::vector<double>& rodTable() const { return rod_; }

private:
    [[nodiscard]] static double at(const std::vector<double>& table, double luminance);

    std::vector<double> cone_, rod_;
};

/// Table of neuralSensitivity() at one frequency over the logarithm of the luminance.
class SensitivityCurve {
public:
    explicit SensitivityCurve(double frequency);
    /// `log10Luminance` is clamped to [-5, 5].
    [[nodiscard]] double at(double log10Luminance) const;

private:
    std::vector<double> values_;
};

/// Weight of a band with this frequency in the quality score. qualityWeight() is that of releases
/// 2.2.1 and 2.2.2, qualityWeight220() that of release 2.2.0.
[[nodiscard]] double qualityWeight(double frequency);
[[nodiscard]] double qualityWeight220(double frequency);

}  // namespace mfar::eval::hdrvdp
