// True (exit status 0) if all pixels in the lowest row of a picture have the same colour. Usage:
// even-last-row PICTURE
#include "hal/virtual/image_files.h"

#include <cstdio>
#include <cstring>
#include <exception>

int main(int argc, char** argv) {
    if (argc != 2) return 64;
    try {
        const mfar::StoredImage picture = mfar::loadImage(argv[1]);
        const mfar::ImageView view = picture.view();
        const std::uint8_t* row = view.data + view.stride * (view.size.height - 1);
        for (int x = 1; x < view.size.width; ++x)
            if (std::memcmp(row, row + 4 * x, 4) != 0) return 1;
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "even-last-row: %s\n", error.what());
        return 74;
    }
}
