// Does not compile: mfar-compile-shaders has to find out.
layout(local_size_x = 1) in;
void main() {
    int whole = 1.0;
}
