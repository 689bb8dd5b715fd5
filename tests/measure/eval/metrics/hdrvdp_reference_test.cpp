#include "tests/measure/eval/metrics/hdrvdp.h"
#include "tests/measure/eval/metrics/hdrvdp_model.h"
#include "tests/measure/eval/metrics/hdrvdp_pathway.h"
#include "tests/measure/eval/metrics/reference_data.h"
#include "tests/measure/eval/metrics/steerable_filters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <map>

namespace mfar::eval {
namespace {

using test::ReferenceRow;
using test::referenceTable;

void expectRelative(double value, double wanted, double relative, const std::string& what) {
    EXPECT_NEAR(value, wanted, relative * std::abs(wanted) + 1e-15) << what;
}

cv::Mat lightOf(const std::string& name, const std::string& encoding) {
    HdrVdpDisplay display;
    if (encoding == "luminance") {
        display.peak = 300.3;
        display.black = 0.3;
    }
    return displayedLight(test::referencePicture(name), display);
}

std::string keyOf(const ReferenceRow& row) {
    return row.text("test") + '/' + row.text("reference") + '/' + row.text("encoding") + '/' +
           row.text("ppd");
}

double numberAfter(const std::string& text) {
    return std::stod(text.substr(text.find('=') + 1));
}

hdrvdp::Emission emissionNamed(const std::string& quantity) {
    if (quantity.ends_with("ccfl-lcd")) return hdrvdp::Emission::FluorescentLcd;
    return quantity.ends_with("led-lcd") ? hdrvdp::Emission::LedLcd : hdrvdp::Emission::Crt;
}

/// Returns the program's value of a constant in the reference table, or NaN if the program does not
/// use the constant.
double constantOf(const ReferenceRow& row, const hdrvdp::ReceptorResponse& response) {
    const std::string &quantity = row.text("quantity"), &a = row.text("arg1"),
                      &b = row.text("arg2");
    const auto share = [](const hdrvdp::ReceptorWeights& w, const std::string& receptor) {
        return receptor == "L" ? w.l : receptor == "M" ? w.m : receptor == "Rod" ? w.rod : NAN;
    };
    if (quantity == "spectral_weight_D65_grey") return share(hdrvdp::kGreyWeights, a);
    if (quantity.starts_with("spectral_weight_"))
        return share(hdrvdp::rgbWeights(emissionNamed(quantity))[std::string("RGB").find(a)], b);
    if (quantity == "mask_p_linear") return hdrvdp::masking().signalExponent;
    if (quantity == "mask_q_linear") return hdrvdp::masking().maskExponent;
    if (quantity == "mask_self_linear") return hdrvdp::masking().self;
    if (quantity == "mask_xo_linear") return hdrvdp::masking().orientations;
    if (quantity == "mask_xn_linear") return hdrvdp::masking().neighbours;
    if (quantity == "jnd_lut_cone") return response.coneTable().at(std::stoul(a) - 1);
    if (quantity == "jnd_lut_rod") return response.rodTable().at(std::stoul(a) - 1);
    if (quantity == "mtf") return hdrvdp::opticsGain(std::stod(a));
    if (quantity == "ncsf") return hdrvdp::neuralSensitivity(numberAfter(a), numberAfter(b));
    if (quantity == "joint_rod_cone_sens_sA") return hdrvdp::jointSensitivity(std::stod(a));
    if (quantity == "rod_sens_sR") return hdrvdp::rodSensitivity(std::stod(a));
    if (quantity == "pix_per_deg")
        return a.starts_with("24in") ? pixelsPerDegree(24, {1920, 1200}, 0.5)
                                     : pixelsPerDegree(30, {3840, 2160}, 0.5);
    return NAN;
}

TEST(HdrVdpReference, ConstantsOfTheEyeMatchTheReferenceTable) {
    const auto table = referenceTable("hdrvdp2_constants.csv");
    if (table.empty()) GTEST_SKIP() << test::referenceFolder().string() << " is not there";
    const hdrvdp::ReceptorResponse response;
    int checked = 0;
    for (const auto& row : table) {
        const double got = constantOf(row, response);
        if (std::isnan(got)) continue;
        const std::string what = row.text("quantity") + ' ' + row.text("arg1") + row.text("arg2");
        expectRelative(got, row.number("value"), 1e-9, what);
        ++checked;
    }
    // Rows of two kinds are not checked: those of the S cones, which the program does not use, and
    // those whose values are only factors of values in other rows.
    EXPECT_EQ(checked, 3 + 27 + 36 + 12 + 90 + 24 + 5 + 2);
}

TEST(HdrVdpReference, PyramidFiltersMatchTheReferenceTable) {
    std::ifstream in(test::referenceFolder() / "sp3_filters.txt");
    if (!in) GTEST_SKIP() << test::referenceFolder().string() << " is not there";
    const SteerableFilters got = steerableFilters();
    const std::map<std::string, const cv::Mat*> filters{
        {"hi0", &got.highPass},      {"lo0", &got.firstLowPass},  {"lo", &got.lowPass},
        {"b1", &got.orientation[0]}, {"b2", &got.orientation[1]}, {"b3", &got.orientation[2]},
        {"b4", &got.orientation[3]}};
    std::string name;
    std::size_t seen = 0;
    for (int rows = 0, cols = 0; in >> name >> rows >> cols; ++seen) {
        const cv::Mat& filter = *filters.at(name);
        ASSERT_EQ(filter.size(), cv::Size(cols, rows)) << name;
        for (int i = 0; i < rows * cols; ++i) {
            double tap = 0;
            in >> tap;
            EXPECT_EQ(filter.at<double>(i / cols, i % cols), tap) << name << ' ' << i;
        }
    }
    EXPECT_EQ(seen, filters.size());
}

TEST(HdrVdpReference, PathwayOfEveryPictureMatchesTheReferenceTable) {
    const auto table = referenceTable("hdrvdp2_pathway.csv");
    if (table.empty()) GTEST_SKIP() << test::referenceFolder().string() << " is not there";
    for (const auto& row : table) {
        const cv::Mat light = lightOf(row.text("image"), row.text("encoding"));
        const auto [got, same] = hdrvdp::pathways(light, light, row.number("ppd"));
        const std::string what = row.text("image") + ' ' + row.text("ppd");
        const auto check = [&](double value, const char* column) {
            expectRelative(value, row.number(column), 1e-8, what + ' ' + column);
        };
        double least = 0, most = 0;
        cv::minMaxLoc(got.adaptation, &least, &most);
        check(cv::mean(got.adaptation)[0], "Ladapt_mean");
        check(least, "Ladapt_min");
        check(most, "Ladapt_max");
        cv::Scalar mean, deviation;
        cv::meanStdDev(got.achromatic, mean, deviation);
        const auto n = static_cast<double>(light.total());
        check(deviation[0] * std::sqrt(n / (n - 1)), "P_std_n-1");
        cv::minMaxLoc(got.achromatic, &least, &most);
        check(least, "P_min");
        check(most, "P_max");
        check(got.achromatic.at<double>(0, 0), "P_y0_x0");
        check(got.achromatic.at<double>(100, 50), "P_y100_x50");
        check(got.adaptation.at<double>(0, 0), "Ladapt_y0_x0");
        check(got.adaptation.at<double>(100, 50), "Ladapt_y100_x50");
    }
}

void expectBand(const HdrVdpBand& got, const ReferenceRow& row, const std::string& key) {
    const std::string what = key + " band " + row.text("band_b") + '/' + row.text("orient_o");
    EXPECT_EQ(got.size,
              cv::Size(static_cast<int>(row.number("cols")), static_cast<int>(row.number("rows"))));
    const auto check = [&](double value, const char* column) {
        expectRelative(value, row.number(column), 1e-6, what + ' ' + column);
    };
    check(got.frequency, "band_freq_cpd");
    check(got.weight, "w_f");
    check(got.error, "msre");
    check(got.sumAbsolute, "sum_abs_D");
    check(got.meanReference, "mean_abs_R");
    check(got.meanTest, "mean_abs_T");
    check(got.meanSensitivity, "mean_CSF");
    check(got.meanSelfMask, "mean_self_mask");
    check(got.meanMasking, "mean_N_mask");
}

TEST(HdrVdpReference, QualityAndBandsOfEveryPairMatchTheReferenceTable) {
    const auto table = referenceTable("hdrvdp2.csv");
    if (table.empty()) GTEST_SKIP() << test::referenceFolder().string() << " is not there";
    std::map<std::string, std::vector<ReferenceRow>> bands;
    for (const auto& row : referenceTable("hdrvdp2_bands.csv"))
        bands[keyOf(row)].push_back(row);
    for (const auto& row : table) {
        const std::string key = keyOf(row);
        const HdrVdpResult got =
            hdrVdp(lightOf(row.text("test"), row.text("encoding")),
                   lightOf(row.text("reference"), row.text("encoding")), row.number("ppd"));
        expectRelative(got.q, row.number("Q_v222"), 1e-7, key);
        expectRelative(got.q220, row.number("Q_v220"), 1e-7, key);
        expectRelative(got.qMos, row.number("Q_MOS_v220"), 1e-7, key);
        ASSERT_EQ(got.bands.size(), bands[key].size()) << key;
        for (const ReferenceRow& band : bands[key])
            for (const HdrVdpBand& b : got.bands)
                if (b.band == band.number("band_b") && b.orientation == band.number("orient_o"))
                    expectBand(b, band, key);
    }
    EXPECT_EQ(table.size(), 30U);
    EXPECT_EQ(bands.size(), table.size());
}

}  // namespace
}  // namespace mfar::eval
