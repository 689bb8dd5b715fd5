// This shader must not compile: a test checks that mfar-compile-shaders reports it.
layout(local_size_x = 1) in;
void main() {
    int whole = 1.0;
}
