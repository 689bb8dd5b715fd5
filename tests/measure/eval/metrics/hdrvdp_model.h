#pragma once

#include <array>
#include <vector>

/// The eye of HDR-VDP-2 (Mantiuk, Kim, Rempel, Heidrich 2011, sections 3 and 4) with the constants
/// of releases 2.2.x. Luminances in cd/m^2, frequencies in cycles/degree.
namespace mfar::eval::hdrvdp {

/// Gain of the eye's optics.
[[nodiscard]] double opticsGain(double frequency);

/// Sensitivity of cones and rods together, and of the rods.
[[nodiscard]] double jointSensitivity(double luminance);
[[nodiscard]] double rodSensitivity(double luminance);

/// Contrast sensitivity without what optics and receptors do to it; 0 for frequency 0.
[[nodiscard]] double neuralSensitivity(double frequency, double luminance);

/// What a pixel of a given light excites: shares of each channel's luminance.
struct ReceptorWeights {
    double l = 0, m = 0, rod = 0;
};
/// Grey of the white point D65.
inline constexpr ReceptorWeights kGreyWeights{0.601847152244699, 0.316708295579169,
                                              0.904670654599503};
/// What makes the light of a display of colours: an LCD with fluorescent lamps or with LEDs behind
/// it, or a cathode ray tube.
enum class Emission { FluorescentLcd, LedLcd, Crt };
/// Of red, green and blue.
[[nodiscard]] const std::array<ReceptorWeights, 3>& rgbWeights(Emission emission);

/// Masking: exponents of a signal and of what masks it; weights of what is in the same band, of
/// its other orientations, and of the bands beside it.
struct Masking {
    double signalExponent, maskExponent;
    double self, orientations, neighbours;
};
[[nodiscard]] const Masking& masking();

/// How strongly receptors answer, in units of just noticeable differences.
class ReceptorResponse {
public:
    ReceptorResponse();
    /// Of an L or M cone, and of a rod; luminances beyond 1e-5 and 1e5 answer as these.
    [[nodiscard]] double cone(double luminance) const { return at(cone_, luminance); }
    [[nodiscard]] double rod(double luminance) const { return at(rod_, luminance); }

    /// The tables, over 2048 luminances evenly spaced in their logarithm.
    [[nodiscard]] const std::vector<double>& coneTable() const { return cone_; }
    [[nodiscard]] const std::vector<double>& rodTable() const { return rod_; }

private:
    [[nodiscard]] static double at(const std::vector<double>& table, double luminance);

    std::vector<double> cone_, rod_;
};

/// neuralSensitivity() at one frequency over the logarithm of the luminance, tabulated.
class SensitivityCurve {
public:
    explicit SensitivityCurve(double frequency);
    /// `log10Luminance` beyond -5 and 5 counts as these.
    [[nodiscard]] double at(double log10Luminance) const;

private:
    std::vector<double> values_;
};

/// How much a band counts at its frequency, by release 2.2.1 = 2.2.2 and by 2.2.0.
[[nodiscard]] double qualityWeight(double frequency);
[[nodiscard]] double qualityWeight220(double frequency);

}  // namespace mfar::eval::hdrvdp
