#include "tests/measure/eval/pose_source_option.h"

#include <map>
#include <string>

namespace mfar::eval {

void addPoseSource(CLI::App& sub, PoseSource& source) {
    const std::map<std::string, PoseSource> sources{
        {"recorded", PoseSource::Recorded}, {"tags", PoseSource::Tags}, {"none", PoseSource::None}};
    sub.add_option_function<std::string>(
           "--poses", [&source, sources](const std::string& name) { source = sources.at(name); },
           "what methods are told: recorded poses (default), tags (the tracker's, from the "
           "pictures "
           "and tags.toml; that of a still from itself) or none")
        ->check(CLI::IsMember({"recorded", "tags", "none"}))
        ->option_text("recorded|tags|none");
}

}  // namespace mfar::eval
