#include "base/calibration/yaml_bounds.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>

#include <sstream>

namespace mfar {
namespace {

class Bounds final : public YAML::EventHandler {
public:
    void OnDocumentStart(const YAML::Mark& /*mark*/) override {}
    void OnDocumentEnd() override {}
    void OnNull(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override { count(mark); }
    void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
        throw YAML::ParserException(mark, "YAML aliases are not supported");
    }
    void OnScalar(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                  const std::string& /*value*/) override {
        count(mark);
    }
    void OnSequenceStart(const YAML::Mark& mark, const std::string& /*tag*/,
                         YAML::anchor_t /*anchor*/, YAML::EmitterStyle::value /*style*/) override {
        begin(mark);
    }
    void OnSequenceEnd() override { --depth_; }
    void OnMapStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                    YAML::EmitterStyle::value /*style*/) override {
        begin(mark);
    }
    void OnMapEnd() override { --depth_; }

private:
    static constexpr int kDeepest = 16, kMostValues = 50'000;

    void count(const YAML::Mark& mark) {
        if (++values_ > kMostValues)
            throw YAML::ParserException(
                mark, fmt::format("the file has more than {} values", kMostValues));
    }
    void begin(const YAML::Mark& mark) {
        count(mark);
        if (++depth_ > kDeepest)
            throw YAML::ParserException(
                mark, fmt::format("the file is nested more than {} levels deep", kDeepest));
    }

    int depth_ = 0, values_ = 0;
};

}  // namespace

YAML::Node boundedYaml(const std::string& text) {
    std::istringstream in(text);
    YAML::Parser parser(in);
    Bounds bounds;
    static_cast<void>(parser.HandleNextDocument(bounds));
    return YAML::Load(text);
}

}  // namespace mfar
