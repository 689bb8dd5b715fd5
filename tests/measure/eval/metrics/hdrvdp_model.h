#pragma once

#include <array>
#include <vector>

/// The model of the human eye in HDR-VDP-2 (Mantiuk, Kim, Rempel, Heidrich 2011, sections 3 and 4),
/// with the constants of releases 2.2.x. Luminances in cd/m^2, frequencies in cycles/degree.
namespace mfar::eval::hdrvdp {

/// Gain of the eye's optics at a spatial frequency.
[[nodiscard]] double opticsGain(double frequency);

/// Sensitivity of cones and rods together, and of the rods.
[[nodiscard]] double jointSensitivity(double luminance);
[[nodiscard]] double rodSensitivity(double luminance);

/// Contrast sensitivity without the effects of optics and receptors. 0 at frequency 0.
[[nodiscard]] double neuralSensitivity(double frequency, double luminance);

/// How strongly a pixel's light excites each kind of receptor, as shares of each channel's
/// luminance.
struct ReceptorWeights {
    double l = 0, m = 0, rod = 0;
};
/// Weights of grey: light of the white point D65.
inline constexpr ReceptorWeights kGreyWeights{0.601847152244699, 0.316708295579169,
                                              0.904670654599503};
/// Light source of a colour display: an LCD with fluorescent lamps or with LEDs, or a cathode ray
/// tube.
enum class Emission { FluorescentLcd, LedLcd, Crt };
/// Weights of red, green and blue light of a display.
[[nodiscard]] const std::array<ReceptorWeights, 3>& rgbWeights(Emission emission);

/// Parameters of masking: exponents of the signal and of the masking signal; weights of masking by
/// the same band, by its other orientations, and by the adjacent bands.
struct Masking {
    double signalExponent, maskExponent;
    double self, orientations, neighbours;
};
[[nodiscard]] const Masking& masking();

/// Response of the receptors in units of just noticeable differences.
class ReceptorResponse {
public:
    ReceptorResponse();
    /// Response of an L or M cone, and of a rod; luminances are clamped to [1e-5, 1e5].
    [[nodiscard]] double cone(double luminance) const { return at(cone_, luminance); }
    [[nodiscard]] double rod(double luminance) const { return at(rod_, luminance); }

    /// The tables have entries for 2048 luminances that are evenly spaced in their logarithm.
    [[nodiscard]] const std::vector<double>& coneTable() const { return cone_; }
    [[nodiscard]] const std::vector<double>& rodTable() const { return rod_; }

private:
    [[nodiscard]] static double at(const std::vector<double>& table, double luminance);

    std::vector<double> cone_, rod_;
};

/// neuralSensitivity() at one frequency as a table over the logarithm of the luminance.
class SensitivityCurve {
public:
    explicit SensitivityCurve(double frequency);
    /// `log10Luminance` is clamped to [-5, 5].
    [[nodiscard]] double at(double log10Luminance) const;

private:
    std::vector<double> values_;
};

/// Weight of a band of this frequency in the quality score: in releases 2.2.1 and 2.2.2, and in
/// release 2.2.0.
[[nodiscard]] double qualityWeight(double frequency);
[[nodiscard]] double qualityWeight220(double frequency);

}  // namespace mfar::eval::hdrvdp
