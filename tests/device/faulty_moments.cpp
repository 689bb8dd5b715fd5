#include "tests/device/faulty_moments.h"

#include "gles_shaders/shaders.h"

#include <map>
#include <string>
#include <vector>

namespace mfar::faulty {
namespace {

int loseAt = -1;
std::vector<std::string> moments;
std::map<unsigned, std::string> shaders, programs;  // names
std::string current;

}  // namespace

bool isLostAt(const char* function) {
    moments.push_back(std::string(function) + " " + current);
    return static_cast<int>(moments.size()) - 1 == loseAt;
}

void sourceOf(unsigned shader, const char* text) {
    for (const mfar::shaders::Source& one : mfar::shaders::all())
        if (one.text == text) shaders[shader] = one.name;
}

// Of a program that draws, the fragment shader is the last one.
void attached(unsigned program, unsigned shader) {
    programs[program] = shaders[shader];
}

void used(unsigned program) {
    current = programs[program];
}

}  // namespace mfar::faulty

using namespace mfar::faulty;

void mfarFaultyGlLoseAt(int moment) {
    moments.clear();
    loseAt = moment;
}

int mfarFaultyGlMoments() {
    return static_cast<int>(moments.size());
}

const char* mfarFaultyGlMoment(int moment) {
    return moments.at(static_cast<std::size_t>(moment)).c_str();
}
