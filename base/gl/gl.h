#pragma once

#include <GLES3/gl31.h>

#include <stdexcept>
#include <string>

namespace mfar::gpu {

/// A GL call failed or a shader did not compile or link.
class GlError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Throws GlError naming `where` when the context has recorded an error. Not for the frame path.
void checkErrors(const char* where);

}  // namespace mfar::gpu
